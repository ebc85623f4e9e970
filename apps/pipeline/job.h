// One run of a verb of the program: what it is told, what it reads, and the folder that it leaves.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace partwise::pipeline {

// A word of a command line. Files are kept as files, so that whoever runs a command and whoever writes it down can each
// name them in his own way.
struct Word {
  enum class Kind { plain, input, output };

  Kind kind = Kind::plain;
  std::string text;  // input: an absolute path; output: relative to the job's folder, "." for the folder itself
};

inline Word plain(std::string text) { return {Word::Kind::plain, std::move(text)}; }
inline Word input(const std::filesystem::path& file) { return {Word::Kind::input, file.string()}; }
inline Word output(std::string name) { return {Word::Kind::output, std::move(name)}; }

// A file that is written into the job's folder before it begins: a configuration that its verb reads there.
struct GivenFile {
  std::string name, text;
};

struct Job {
  std::string stage;
  std::string name;           // its folder, relative to the output folder; no two jobs have the same
  std::vector<Word> words{};  // the verb comes first
  // Absolute: files, and folders of other jobs, which stand for all that these leave. A job comes after those whose
  // folders its inputs are or lie in.
  std::vector<std::filesystem::path> inputs{};
  std::vector<GivenFile> given{};
  std::vector<std::string> outputs{};      // what has to be there afterwards; whatever else is there is kept as well
  std::vector<std::string> accessories{};  // how names begin of what is never twice the same: logs with times
  bool goes_on = false;                    // the verb goes on in a folder where it was stopped
  bool wide = false;                       // runs alone, on all threads
  int threads = 0;                         // so many, always: its bytes depend on them; 0: as many as are free
  // Where the configuration asks for it ("training.editing"), of a verb that has --check: what was given to it is
  // looked at before any job begins. Empty: it is not.
  std::string checked_as{};
  // How it does without those of its inputs that jobs would have made which failed. Unset: it cannot.
  std::function<Job(const std::set<std::string>& failed)> without{};
};

}  // namespace partwise::pipeline
