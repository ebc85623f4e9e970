#include "partwise/appearance/shapes/model_archive.h"

#include <archive.h>
#include <archive_entry.h>
#include <gmock/gmock.h>

#include <fstream>
#include <map>

#include "partwise/appearance/shapes/java_properties.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(JavaProperties, AreReadAsJavaReadsThem) {
  const auto read = read_properties(
      "# a comment \\\nname = Caf\\u00e9\r\n! another\nkey\\ with\\:blanks:value = 1\n  long = one\\\n    two\n"
      "latin=\xE9\nbare\nname#2=B");
  const std::map<std::string, std::string> expected = {{"name", "Caf\xC3\xA9"},
                                                       {"key with:blanks", "value = 1"},
                                                       {"long", "onetwo"},
                                                       {"latin", "\xC3\xA9"},
                                                       {"bare", ""},
                                                       {"name#2", "B"}};
  EXPECT_EQ(read, expected);
}

// A box of 1 x 2 x 4 whose long side is along z.
constexpr char kBox[] =
    "mtllib box.mtl\nv 0 0 0\nv 1 0 0\nv 0 2 0\nv 1 2 0\nv 0 0 4\nv 1 0 4\nv 0 2 4\nv 1 2 4\n"
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
// Turned so that z becomes y; 50 cm wide, 200 high, 100 deep.
constexpr char kCatalogue[] =
    "license=CC0\nid#1=Some#Maker#box\nname#1=Box\ncategory#1=Office\nmodel#1=/models/box/box.obj\ncreator#1=Me\n"
    "modelRotation#1=1 0 0 0 0 1 0 -1 0\nwidth#1=50\nheight#1=200\ndepth#1=100\n"
    "id#2=Maker#gone\nmodel#2=/models/gone.obj\nlicense#2=CC BY\n"
    "id#3=Maker#broken\nmodel#3=/models/broken.obj\n";

class ModelArchiveTest : public testing::Test {
 protected:
  std::filesystem::path zip(const std::map<std::string, std::string>& entries) {
    const std::filesystem::path path = folder_.path() / "models.sh3f";
    archive* writer = archive_write_new();
    archive_write_set_format_zip(writer);
    EXPECT_EQ(archive_write_open_filename(writer, path.c_str()), ARCHIVE_OK);
    for (const auto& [name, bytes] : entries) {
      archive_entry* entry = archive_entry_new();
      archive_entry_set_pathname(entry, name.c_str());
      archive_entry_set_size(entry, static_cast<la_int64_t>(bytes.size()));
      archive_entry_set_filetype(entry, AE_IFREG);
      archive_entry_set_perm(entry, 0644);
      EXPECT_EQ(archive_write_header(writer, entry), ARCHIVE_OK);
      EXPECT_EQ(archive_write_data(writer, bytes.data(), bytes.size()), static_cast<la_ssize_t>(bytes.size()));
      archive_entry_free(entry);
    }
    archive_write_free(writer);
    return path;
  }

  std::filesystem::path good() {
    return zip({{"PluginFurnitureCatalog.properties", kCatalogue},
                {"models/box/box.obj", kBox},
                {"models/broken.obj", "v 0 0\n"}});
  }

  TestFolder folder_;
};

TEST_F(ModelArchiveTest, ModelsStandAsTheCatalogueSays) {
  const ModelArchive archive(good());
  ASSERT_EQ(archive.models().size(), 3u);
  const CatalogueModel& box = archive.model("box");
  EXPECT_EQ(box.name, "Box");
  EXPECT_EQ(box.licence, "CC0");
  EXPECT_EQ(archive.model("gone").licence, "CC BY");
  const Mesh mesh = archive.read("box");
  EXPECT_EQ(mesh.faces.rows(), 12);
  const Eigen::RowVector3d low = mesh.vertices.colwise().minCoeff(), high = mesh.vertices.colwise().maxCoeff();
  EXPECT_TRUE(low.isApprox(Eigen::RowVector3d(-0.25, -1, -0.5))) << low;
  EXPECT_TRUE(high.isApprox(Eigen::RowVector3d(0.25, 1, 0.5))) << high;
  EXPECT_NEAR(signed_volume(mesh), 1, 1e-12);                                     // not mirrored
  EXPECT_TRUE(mesh.vertices.row(4).isApprox(Eigen::RowVector3d(-0.25, 1, 0.5)));  // (0, 0, 4) was the top
}

TEST_F(ModelArchiveTest, WhatIsNotThereIsSaidInALine) {
  const ModelArchive archive(good());
  EXPECT_THAT([&] { archive.read("table"); },
              ThrowsMessage<InputError>(HasSubstr("has no model \"table\" among its 3; \"box\" is")));
  EXPECT_THAT([&] { archive.read("gone"); },
              ThrowsMessage<InputError>(HasSubstr("models/gone.obj: the archive has no such entry")));
  EXPECT_THAT([&] { archive.read("broken"); },
              ThrowsMessage<InputError>(HasSubstr("models/broken.obj:1: a vertex has fewer")));
}

TEST_F(ModelArchiveTest, OtherFilesAreRefused) {
  const std::filesystem::path other = folder_.path() / "other.sh3f";
  EXPECT_THAT([&] { ModelArchive{other}; }, ThrowsMessage<InputError>(HasSubstr("other.sh3f: is not there")));
  std::ofstream(other) << "PK nothing of the kind";
  EXPECT_THAT([&] { ModelArchive{other}; }, ThrowsMessage<InputError>(HasSubstr("other.sh3f: is no zip archive")));
  EXPECT_THAT(
      [&] {
        ModelArchive{zip({{"a.txt", "a"}})};
      },
      ThrowsMessage<InputError>(HasSubstr("PluginFurnitureCatalog.properties: the archive has no such")));
  EXPECT_THAT(
      [&] {
        ModelArchive{zip({{"PluginFurnitureCatalog.properties", "name=x"}})};
      },
      ThrowsMessage<InputError>(HasSubstr("lists no models")));
  EXPECT_THAT(
      [&] {
        ModelArchive{zip({{"PluginFurnitureCatalog.properties", "model#1=a.obj\nwidth#1=wide\n"}})};
      },
      ThrowsMessage<InputError>(HasSubstr("\"wide\" is not a number")));
}

// Wherever an archive is cut off, reading it ends with a message.
TEST_F(ModelArchiveTest, CutOffArchivesAreRefused) {
  const std::string bytes = read_bytes(good());
  const std::filesystem::path cut = folder_.path() / "cut.sh3f";
  for (std::size_t length = 0; length < bytes.size(); length += 7) {
    std::ofstream(cut, std::ios::binary) << bytes.substr(0, length);
    EXPECT_THROW(ModelArchive(cut).read("box"), InputError) << length;
  }
}

}  // namespace
}  // namespace partwise
