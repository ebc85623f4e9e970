#include "partwise/parts/solid/robot_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>
#include <unistd.h>

#include <iterator>
#include <sstream>

#include "partwise/base/error.h"
#include "partwise/geometry/mesh_io.h"

namespace partwise {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Mesh tetrahedron(double x) {
  Mesh mesh{Vertices(4, 3), Faces(4, 3)};
  mesh.vertices << x, 0, 0, x + 1, 0, 0, x, 1, 0, x, 0, 1;
  mesh.faces << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  return mesh;
}

std::vector<double> numbers(const char* text) {
  std::istringstream stream(text);
  return {std::istream_iterator<double>(stream), {}};
}

class RobotFiles : public testing::Test {
 protected:
  RobotFiles() : folder_(std::filesystem::path(testing::TempDir()) / fmt::format("partwise_robot_{}", ::getpid())) {
    std::filesystem::create_directories(folder_);
    body_.mass = mass_properties(std::span<const Mesh>(hulls_));
  }
  ~RobotFiles() override { std::filesystem::remove_all(folder_); }

  // The file that an attribute names, read again.
  Mesh named(const std::string& relative) { return read_mesh(folder_ / relative); }

  std::filesystem::path folder_;
  std::vector<Mesh> hulls_{tetrahedron(0), tetrahedron(2), tetrahedron(5)};
  Mesh visual_ = tetrahedron(-1);
  RobotBody body_{.name = "a \"cup\" & <saucer>", .hulls = hulls_, .visual = &visual_, .mass = {}};
};

TEST_F(RobotFiles, UrdfNamesItsHullsMassAndInertia) {
  const std::filesystem::path path = folder_ / "my cup.v2.urdf";
  write_urdf(path, body_);
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.LoadFile(path.c_str()), tinyxml2::XML_SUCCESS) << xml.ErrorStr();
  const tinyxml2::XMLElement* robot = xml.RootElement();
  ASSERT_STREQ(robot->Name(), "robot");
  EXPECT_EQ(robot->Attribute("name"), body_.name);
  const tinyxml2::XMLElement* link = robot->FirstChildElement("link");
  EXPECT_EQ(link->Attribute("name"), body_.name);

  const tinyxml2::XMLElement* inertial = link->FirstChildElement("inertial");
  EXPECT_DOUBLE_EQ(inertial->FirstChildElement("mass")->DoubleAttribute("value"), 500);  // 3 / 6 m^3
  const auto centre = numbers(inertial->FirstChildElement("origin")->Attribute("xyz"));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(centre[k], body_.mass.centre[k]);
  const tinyxml2::XMLElement* inertia = inertial->FirstChildElement("inertia");
  EXPECT_EQ(inertia->DoubleAttribute("iyy"), 1000 * body_.mass.inertia(1, 1));
  EXPECT_EQ(inertia->DoubleAttribute("ixz"), 1000 * body_.mass.inertia(0, 2));

  std::size_t count = 0;
  for (auto* each = link->FirstChildElement("collision"); each; each = each->NextSiblingElement("collision")) {
    const Mesh mesh = named(each->FirstChildElement("geometry")->FirstChildElement("mesh")->Attribute("filename"));
    ASSERT_LT(count, hulls_.size());
    EXPECT_EQ(mesh.vertices, hulls_[count].vertices);
    EXPECT_EQ(mesh.faces, hulls_[count++].faces);
  }
  EXPECT_EQ(count, hulls_.size());
  const tinyxml2::XMLElement* visual = link->FirstChildElement("visual");
  EXPECT_EQ(named(visual->FirstChildElement("geometry")->FirstChildElement("mesh")->Attribute("filename")).vertices,
            visual_.vertices);
  EXPECT_EQ(visual->NextSiblingElement("visual"), nullptr);
}

TEST_F(RobotFiles, MjcfNamesItsHullsMassAndInertia) {
  const std::filesystem::path path = folder_ / "cup.xml";
  body_.density = 500;
  write_mjcf(path, body_);
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.LoadFile(path.c_str()), tinyxml2::XML_SUCCESS) << xml.ErrorStr();
  const tinyxml2::XMLElement* root = xml.RootElement();
  ASSERT_STREQ(root->Name(), "mujoco");
  const std::string directory = root->FirstChildElement("compiler")->Attribute("meshdir");
  EXPECT_EQ(directory, "cup_hulls");
  const tinyxml2::XMLElement* body = root->FirstChildElement("worldbody")->FirstChildElement("body");
  EXPECT_EQ(body->Attribute("name"), body_.name);
  EXPECT_NE(body->FirstChildElement("freejoint"), nullptr);
  const tinyxml2::XMLElement* inertial = body->FirstChildElement("inertial");
  EXPECT_DOUBLE_EQ(inertial->DoubleAttribute("mass"), 250);
  const auto inertia = numbers(inertial->Attribute("fullinertia"));
  const Eigen::Matrix3d& wanted = body_.mass.inertia;
  EXPECT_THAT(inertia, testing::ElementsAre(500 * wanted(0, 0), 500 * wanted(1, 1), 500 * wanted(2, 2),
                                            500 * wanted(0, 1), 500 * wanted(0, 2), 500 * wanted(1, 2)));

  // Every geom names an asset, every asset a file.
  std::size_t colliding = 0;
  for (auto* geom = body->FirstChildElement("geom"); geom; geom = geom->NextSiblingElement("geom")) {
    const std::string wanted_mesh = geom->Attribute("mesh");
    const tinyxml2::XMLElement* asset = root->FirstChildElement("asset")->FirstChildElement("mesh");
    while (asset && asset->Attribute("name") != wanted_mesh) asset = asset->NextSiblingElement("mesh");
    ASSERT_NE(asset, nullptr) << wanted_mesh;
    const Mesh mesh = named(directory + "/" + asset->Attribute("file"));
    if (geom->IntAttribute("contype", 1) == 0) {
      EXPECT_EQ(mesh.vertices, visual_.vertices);
    } else {
      ASSERT_LT(colliding, hulls_.size());
      EXPECT_EQ(mesh.vertices, hulls_[colliding++].vertices);
    }
  }
  EXPECT_EQ(colliding, hulls_.size());
}

TEST_F(RobotFiles, WithoutAVisualTheHullsAreDrawn) {
  body_.visual = nullptr;
  write_urdf(folder_ / "cup.urdf", body_);
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.LoadFile((folder_ / "cup.urdf").c_str()), tinyxml2::XML_SUCCESS);
  std::size_t count = 0;
  const tinyxml2::XMLElement* link = xml.RootElement()->FirstChildElement("link");
  for (auto* each = link->FirstChildElement("visual"); each; each = each->NextSiblingElement("visual")) ++count;
  EXPECT_EQ(count, hulls_.size());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cup_hulls" / "visual.obj"));
}

TEST_F(RobotFiles, NoXmlWhenAHullCannotBeWritten) {
  std::filesystem::create_directories(folder_ / "cup_hulls" / "hull_002.obj" / "in the way");
  EXPECT_THROW(write_urdf(folder_ / "cup.urdf", body_), InputError);
  EXPECT_THROW(write_mjcf(folder_ / "cup.xml", body_), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cup.urdf"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cup.xml"));
}

TEST_F(RobotFiles, RefusesWhatIsNoRigidBody) {
  RobotBody empty = body_;
  empty.hulls = {};
  EXPECT_THAT([&] { write_urdf(folder_ / "a.urdf", empty); }, ThrowsMessage<InputError>(HasSubstr("no hulls")));
  RobotBody massless = body_;
  massless.mass = {};
  EXPECT_THAT([&] { write_mjcf(folder_ / "a.xml", massless); }, ThrowsMessage<InputError>(HasSubstr("rigid body")));
  RobotBody light = body_;
  light.density = 0;
  EXPECT_THAT([&] { write_urdf(folder_ / "a.urdf", light); }, ThrowsMessage<InputError>(HasSubstr("density")));
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(RobotFiles, MassIsOfTheMeshIfClosedElseOfTheHulls) {
  Mesh mesh = tetrahedron(0);
  mesh.vertices *= 2;
  EXPECT_NEAR(body_mass(mesh, hulls_).volume, 8.0 / 6, 1e-15);
  Mesh open = mesh;
  open.faces.conservativeResize(3, 3);
  EXPECT_NEAR(body_mass(open, hulls_).volume, 3.0 / 6, 1e-15);
  Mesh doubled = mesh;  // closed, but without volume
  doubled.faces.resize(2, 3);
  doubled.faces << 0, 1, 2, 0, 2, 1;
  EXPECT_NEAR(body_mass(doubled, hulls_).volume, 3.0 / 6, 1e-15);
}

}  // namespace
}  // namespace partwise
