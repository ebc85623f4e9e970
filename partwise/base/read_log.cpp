#include "partwise/base/read_log.h"

#include <mutex>
#include <set>

namespace partwise {
namespace {

struct Log {
  std::mutex mutex;
  bool kept = false;
  std::set<std::filesystem::path> files;
};

Log& the_log() {
  static Log log;
  return log;
}

}  // namespace

void keep_read_log() {
  Log& log = the_log();
  const std::lock_guard lock(log.mutex);
  log.kept = true;
}

void note_read(const std::filesystem::path& path) {
  Log& log = the_log();
  const std::lock_guard lock(log.mutex);
  if (log.kept) log.files.insert(path);
}

std::vector<std::filesystem::path> files_read() {
  Log& log = the_log();
  const std::lock_guard lock(log.mutex);
  return {log.files.begin(), log.files.end()};
}

}  // namespace partwise
