// The files that a run was asked for: all of them appear, or none does.
//
// Every output is named before the long work, so that a missing folder or two options that name the same file are told
// at once. It is then written into a hidden folder beside its final place, with whatever files it brings along, and
// commit() moves all of them. Without commit() (an error, Ctrl-C) nothing is left and what was there before is
// untouched. A device or a pipe (/dev/stdout) is copied to by commit().
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace partwise::cli {

// The command line itself is wrong; the program exits with 2.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The ending of a file's name in small letters, with the dot.
std::string lower_ending(const std::filesystem::path& path);

class Outputs {
 public:
  Outputs() = default;
  ~Outputs();
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  // A file that is read. Errors: UsageError when an output means the same file.
  void add_input(const std::string& option, const std::filesystem::path& path);

  // An output. `endings` are those allowed, in small letters and with the dot; none: any.
  // Errors: UsageError for the same file twice or another ending; InputError for a folder that is missing or protected.
  void add(const std::string& option, const std::filesystem::path& path, const std::vector<std::string>& endings = {});

  // Where the output of `option` is to be written; it must have been added.
  std::filesystem::path staged(const std::string& option);

  // Moves everything into place. Errors: InputError; then nothing new is left, save what a device has taken already.
  void commit();

 private:
  struct Entry {
    std::string option;
    std::filesystem::path path;       // as the user named it
    std::filesystem::path final{};    // absolute, links followed
    std::filesystem::path staging{};  // the hidden folder, once there is one
    bool is_input = false;
    bool is_device = false;
  };

  void refuse_same_file(const Entry& entry) const;

  std::vector<Entry> entries_;
};

}  // namespace partwise::cli
