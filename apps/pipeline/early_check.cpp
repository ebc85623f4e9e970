#include "pipeline/early_check.h"

#include <string>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "pipeline/child_process.h"

namespace partwise::pipeline {
namespace {

namespace fs = std::filesystem;

// A folder beside that of the job, from where files have the same names; gone afterwards.
class CheckFolder {
 public:
  explicit CheckFolder(const fs::path& folder) : path_(folder.string() + ".check") { fs::create_directories(path_); }
  ~CheckFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  CheckFolder(const CheckFolder&) = delete;
  CheckFolder& operator=(const CheckFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

bool was_made_from(const fs::path& folder, const GivenFile& given) {
  std::error_code error;
  return fs::is_regular_file(folder / given.name, error) && read_bytes(folder / given.name) == given.text;
}

// "FILE: PLACE is wrong; remedy" of the file that was given, as a mistake in the pipeline's configuration.
[[noreturn]] void refuse(const fs::path& config, const std::string& section, const fs::path& given, std::string line) {
  const std::string file = given.string() + ": ";
  if (line.starts_with(file)) {
    line = section + "." + line.substr(file.size());
  } else {
    line = section + ": " + line;
  }
  const std::size_t remedy = line.find("; ");
  throw InputError(config.string(), line.substr(0, remedy),
                   remedy == std::string::npos ? "correct it" : line.substr(remedy + 2));
}

void check(const Plan& plan, const Job& job, const fs::path& program, const Progress& progress) {
  const CheckFolder folder(plan.output / job.name);
  const fs::path file = folder.path() / job.given.front().name;
  write_file(file, job.given.front().text);
  ChildProcess child(program, {job.words.front().text, file.string(), "--check", "--quiet"});
  while (!child.ended_within(100)) progress("looking at " + job.checked_as, 0);
  if (child.wait() != 0) refuse(plan.config, job.checked_as, file, child.last_line());
}

}  // namespace

void check_early(const Plan& plan, const fs::path& program, const Progress& progress) {
  for (const Job& job : plan.jobs) {
    if (job.checked_as.empty()) continue;
    const fs::path folder = plan.output / job.name;
    const GivenFile& given = job.given.front();
    if (was_made_from(folder, given) || was_made_from(folder.string() + ".unfinished", given)) continue;
    check(plan, job, program, progress);
  }
}

}  // namespace partwise::pipeline
