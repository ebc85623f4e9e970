#include "partwise/base/shared_files.h"

#include <gmock/gmock.h>
#include <stdlib.h>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class SharedFiles : public testing::Test {
 protected:
  SharedFiles() { ::unsetenv("PARTWISE_DATA"); }
  ~SharedFiles() override { ::unsetenv("PARTWISE_DATA"); }
};

TEST_F(SharedFiles, SourceTreeComesLast) {
  EXPECT_TRUE(fs::equivalent(shared_file("partwise/base/shared_files.h"),
                             fs::path(PARTWISE_TEST_DATA) / "partwise/base/shared_files.h"));
}

TEST_F(SharedFiles, EnvironmentComesFirstAndFallsThrough) {
  const TestFolder folder;
  ::setenv("PARTWISE_DATA", folder.path().c_str(), 1);
  fs::create_directories(folder.path() / "partwise/base");
  write_file(folder.path() / "partwise/base/shared_files.h", "");
  EXPECT_EQ(shared_file("partwise/base/shared_files.h"), folder.path() / "partwise/base/shared_files.h");
  EXPECT_TRUE(fs::exists(shared_file("partwise/base/shared_files.cpp")));
}

TEST_F(SharedFiles, SaysWhereItLooked) {
  ::setenv("PARTWISE_DATA", "/no/such/place", 1);
  EXPECT_THAT([] { shared_file("data/none"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("data/none"), HasSubstr("/no/such/place"),
                                              HasSubstr("share/partwise"), HasSubstr("set PARTWISE_DATA"))));
  EXPECT_THROW(shared_file("/etc/passwd"), InputError);
  EXPECT_THROW(shared_file(""), InputError);
}

}  // namespace
}  // namespace partwise
