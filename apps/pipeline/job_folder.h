// The folder of a job: whether what it holds still stands, and how a new one is begun, finished and put in its place.
//
// A job works in NAME.unfinished beside its folder, which takes the place of the old one in one move once it is whole,
// with job.json (job_record.h) in it. So a folder without that ending is done, at any moment. An unfinished folder of a
// verb that goes on by itself is taken up again if it was begun from the same; any other is begun anew.
//
// A job stands if its command, the files given to it, all that it read and all that it left are as they were, by their
// hashes.
//
// Errors: InputError for folders that cannot be written, inputs that are not there or changed while they were read, and
// outputs that are missing.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/file_hashes.h"
#include "pipeline/job.h"
#include "pipeline/job_record.h"

namespace partwise::pipeline {

struct Workplace {
  std::filesystem::path output;   // canonical
  std::filesystem::path program;  // partwise
  std::string version;
};

class JobFolder {
 public:
  JobFolder(const Workplace& place, const Job& job, FileHashes& hashes);

  // Empty if the job stands, with `record` as it was made; else why it has to be made, for people.
  std::string reason() const { return reason_; }
  const JobRecord& record() const { return record_; }

  // Makes ready to run. The command line for one who works in the folder `from`, without the program's name.
  std::vector<std::string> begin(const std::filesystem::path& from);

  // What the verb says of its run, as --json gives it. Empty while it has not run to its end.
  std::filesystem::path report() const { return unfinished_ / "report.json"; }

  // Checks what was made, keeps the record, and moves the folder into its place.
  void finish(const std::filesystem::path& from, double seconds);

  // What is left of a job that failed is removed, unless its verb goes on with it.
  void give_up();

 private:
  std::filesystem::path file_named(const std::string& name) const;
  std::string name_of(const std::filesystem::path& file) const;
  std::string name_of_read(const std::filesystem::path& file) const;
  void add_input(const std::filesystem::path& input);
  std::string why_not(const JobRecord& before);
  std::vector<std::string> command(const std::filesystem::path& folder, const std::filesystem::path& from) const;
  void expect_unchanged(const std::filesystem::path& file) const;

  const Workplace& place_;
  const Job& job_;
  FileHashes& hashes_;
  std::filesystem::path folder_, unfinished_;
  std::filesystem::path shipped_;
  std::map<std::string, std::string> inputs_;  // name and hash
  JobRecord record_;
  std::string reason_;
  std::filesystem::file_time_type began_;
};

}  // namespace partwise::pipeline
