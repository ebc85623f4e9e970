// Problems in each format whose poses are worked out by hand. data/problem_corpus has what goes wrong.
#include "partwise/motion/planning_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/motion/test_scenes.h"

namespace partwise {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using ::testing::HasSubstr;

constexpr double pi = std::numbers::pi;

class PlanningProblemFiles : public ::testing::Test {
 protected:
  std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
  std::filesystem::path put(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }
  void put(const std::string& name, const Mesh& mesh) const { write_mesh(path(name), mesh); }

  // The corner of a box at 1, 2, 3 and its mean at 2, 4, 6: no axis is like another.
  void put_corner_box() const { put("box.obj", box_mesh({1, 2, 3}, {3, 6, 9})); }

 private:
  TestFolder folder_;
};

Vector3d low(const Mesh& mesh) { return mesh.vertices.colwise().minCoeff().transpose(); }
Vector3d high(const Mesh& mesh) { return mesh.vertices.colwise().maxCoeff().transpose(); }

void expect_near(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_LT((a - b).norm(), 1e-12) << a.transpose() << " and " << b.transpose();
}

void expect_pose(const PlanningProblem& problem, const Configuration& q, const Matrix3d& rotation,
                 const Vector3d& position) {
  const Eigen::Isometry3d pose = ConfigurationSpace(problem.kind, problem.bounds, 1).pose(q);
  EXPECT_LT((pose.linear() - rotation).norm(), 1e-12) << pose.linear();
  EXPECT_LT((pose.translation() - position).norm(), 1e-12) << pose.translation();
}

constexpr const char* kSe3 =
    "start.x=1\nstart.y=2\nstart.z=3\nstart.theta=1.5707963267948966\nstart.axis.x=0\nstart.axis.y=0\nstart.axis.z=-2\n"
    "goal.x=4\ngoal.y=5\ngoal.z=6\ngoal.theta=3.141592653589793\ngoal.axis.x=1\ngoal.axis.y=0\ngoal.axis.z=0\n";

TEST_F(PlanningProblemFiles, CfgOfSe3TurnsByAngleAndAxis) {
  put_corner_box();
  const PlanningProblem problem = read_planning_problem(
      put("a.cfg", "[problem]\nname = two rooms\nrobot = box.obj\nworld = box.obj\n" + std::string(kSe3) +
                       "volume.min.x=-10\nvolume.min.y=-11\nvolume.min.z=-12\nvolume.max.x=10\nvolume.max.y=11\n"
                       "volume.max.z=12\n"));
  EXPECT_EQ(problem.name, "two rooms");
  EXPECT_EQ(problem.kind, SpaceKind::se3);
  expect_near(problem.bounds.min(), Vector3d(-10, -11, -12));
  expect_near(problem.bounds.max(), Vector3d(10, 11, 12));
  EXPECT_FALSE(problem.bounds_hold_body);
  ASSERT_EQ(problem.queries.size(), 1u);
  Matrix3d quarter, half;  // a quarter turn about -z, half a turn about x
  quarter << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  half << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  expect_pose(problem, problem.queries[0].start, quarter, {1, 2, 3});
  expect_pose(problem, problem.queries[0].goal, half, {4, 5, 6});
  // The world stays, the robot's mean goes to its origin.
  ASSERT_EQ(problem.obstacles.size(), 1u);
  expect_near(low(problem.obstacles[0]), Vector3d(1, 2, 3));
  ASSERT_EQ(problem.robot.size(), 1u);
  expect_near(low(problem.robot[0]), Vector3d(-1, -2, -3));
}

// A pyramid over a square: each corner of the base meets three directions of faces, the apex four, so that the apex at
// height 4 weighs 4 of 16, as OMPL.app's importer has it, not 1 of 5.
TEST_F(PlanningProblemFiles, CfgCentresTheRobotWhereItsImporterDoes) {
  Mesh pyramid;
  pyramid.vertices.resize(5, 3);
  pyramid.vertices << 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 1, 4;
  pyramid.faces.resize(6, 3);
  pyramid.faces << 0, 2, 1, 0, 3, 2, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4;
  put("pyramid.off", pyramid);
  put_corner_box();
  const std::string meshes = "[problem]\nrobot = pyramid.off\nworld = box.obj\n";
  const PlanningProblem solid = read_planning_problem(put("a.cfg", meshes + kSe3));
  expect_near(low(solid.robot[0]), Vector3d(-1, -1, -1));
  expect_near(high(solid.robot[0]), Vector3d(1, 1, 3));
  const PlanningProblem flat = read_planning_problem(
      put("b.cfg", meshes + "start.x=0\nstart.y=0\nstart.theta=0\ngoal.x=1\ngoal.y=1\ngoal.theta=0\n"));
  expect_near(low(flat.robot[0]), Vector3d(-1, -1, 0));
}

TEST_F(PlanningProblemFiles, CfgOfSe2WithoutVolumeIsAsWideAsWorldStartAndGoal) {
  put_corner_box();
  const PlanningProblem problem = read_planning_problem(
      put("maze.cfg",
          "[problem] # a maze\nrobot = box.obj\nworld = box.obj\nstart.x = 0.5\nstart.y = 4\nstart.theta = 0\n"
          "goal.x = 2\ngoal.y = 7\ngoal.theta = 4.71238898038469\n[planner]\nrrt=\nrrt=\n"));
  EXPECT_EQ(problem.name, "maze");
  EXPECT_EQ(problem.kind, SpaceKind::se2);
  expect_near(problem.bounds.min(), Vector3d(0.5, 2, 0));
  expect_near(problem.bounds.max(), Vector3d(3, 7, 0));
  expect_near(problem.queries[0].goal, Vector3d(2, 7, -pi / 2));
}

TEST_F(PlanningProblemFiles, EnvTurnsAboutFixedAxesXFirst) {
  put_corner_box();
  const PlanningProblem problem =
      read_planning_problem(put("a.env",
                                "Boundary Box [-90:90 ; -91:91 ; -92:92]\nMultibodies\n6\n"
                                "Active\n1\nbox.obj Volumetric Rotational\nConnections\n0\n"
                                "Passive\nbox.obj -a(NONE) 10 20 30 0 0 0\nPassive\nbox.obj -a(NONE) 0 0 0 90 0 90\n"
                                "Passive\nbox.obj -a(NONE) 10 20 30 90 90 90\nPassive\nbox.obj 10 20 30 0 0 90\n"
                                "Passive\nbox.obj -a(SURFACE) -c(1 1 1 1) 10 20 30 0 0 0\n"));
  ASSERT_EQ(problem.obstacles.size(), 5u);
  expect_near(low(problem.obstacles[0]), Vector3d(11, 22, 33));
  // (x, y, z) goes to (x, -z, y) about x, then to (z, x, y) about z.
  expect_near(low(problem.obstacles[1]), Vector3d(3, 1, 2));
  expect_near(high(problem.obstacles[1]), Vector3d(9, 3, 6));
  // (x, -z, y), then (y, -z, -x) about y, then (z, y, -x) about z.
  expect_near(low(problem.obstacles[2]), Vector3d(13, 22, 27));
  expect_near(high(problem.obstacles[2]), Vector3d(19, 26, 29));
  // The mean 2, 4, 6 goes to the origin first: half sides 1, 2, 3, then x and y change places.
  expect_near(low(problem.obstacles[3]), Vector3d(8, 19, 27));
  expect_near(low(problem.obstacles[4]), Vector3d(9, 22, 27));
  expect_near(low(problem.robot[0]), Vector3d(-1, -2, -3));
  EXPECT_TRUE(problem.bounds_hold_body);
  EXPECT_TRUE(problem.queries.empty());
}

// The child's point p goes to p + (0, 0, 1) by B; by a quarter turn about x, the shift (2, 0, 3) and a quarter turn
// about z to (z + 1, x + 2, y + 3); by A one farther along x.
TEST_F(PlanningProblemFiles, EnvJoinsBodiesByFixedJoints) {
  put_corner_box();
  put("a.env", "Boundary Box [-90:90 ; -90:90 ; -90:90]\nMultibodies\n1\nPassive\nbox.obj 50 0 0 0 0 0\n");
  put("a.robot",
      "3\nbox.obj -a(NONE) Volumetric Rotational\nbox.obj -a(NONE) Joint\nbox.obj -a(NONE) Joint\nConnections\n2\n"
      "1 2 NonActuated\n0 0 100 0 0 0   0 0 0 0   0 0 0 0 0 0\n"
      "0 1 nonactuated\n1 0 0 0 0 0\n1.5707963267948966 2 3 1.5707963267948966\n0 0 1 0 0 0\n");
  const PlanningProblem problem = read_planning_problem(path("a.env"));
  ASSERT_EQ(problem.robot.size(), 3u);
  expect_near(low(problem.robot[0]), Vector3d(1, 2, 3));
  expect_near(low(problem.robot[1]), Vector3d(3 + 2, 1 + 2, 2 + 3));
  expect_near(high(problem.robot[1]), Vector3d(9 + 2, 3 + 2, 6 + 3));
  // The third is 100 along the second's z, which is the robot's x.
  expect_near(low(problem.robot[2]), Vector3d(3 + 102, 1 + 2, 2 + 3));
}

TEST_F(PlanningProblemFiles, QueriesAreInUnitsOfPiAndGoOnFromGoalToGoal) {
  put_corner_box();
  const std::string body = "Connections\n0\nPassive\nbox.obj 50 0 0 0 0 0\n";
  put("a.env",
      "Boundary Box [-90:90 ; -90:90 ; -90:90]\nMultibodies\n2\nActive\n1\nbox.obj Volumetric Rotational\n" + body);
  put("a.query", "0 1 2 3 0.5 0.5 0.5\n\n0 4 5 6 0.5 0 1 \n# home\n0 0 0 0 0 0 2\n");
  const PlanningProblem solid = read_planning_problem(path("a.env"));
  ASSERT_EQ(solid.queries.size(), 2u);
  Matrix3d all, two;  // as in the test above; (x, -z, y), then half a turn about z to (-x, z, y)
  all << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  two << -1, 0, 0, 0, 0, 1, 0, 1, 0;
  expect_pose(solid, solid.queries[0].start, all, {1, 2, 3});
  expect_pose(solid, solid.queries[0].goal, two, {4, 5, 6});
  expect_near(solid.queries[1].start, solid.queries[0].goal);
  expect_pose(solid, solid.queries[1].goal, Matrix3d::Identity(), {0, 0, 0});

  const auto flat = put(
      "flat.env", "Boundary Box2D [-90:90 ; -90:90]\nMultibodies\n2\nActive\n1\nbox.obj Planar Rotational\n" + body);
  const auto query = put("other.query", "0 1 2 0.5\n0 3 4 1\n");
  const PlanningProblem planar = read_planning_problem(flat, {.robot = {}, .query = query});
  EXPECT_EQ(planar.kind, SpaceKind::se2);
  expect_near(planar.queries[0].start, Vector3d(1, 2, pi / 2));
  expect_near(planar.queries[0].goal, Vector3d(3, 4, -pi));
}

TEST_F(PlanningProblemFiles, TheOnlyRobotBesideIsTaken) {
  put_corner_box();
  const auto env = put("trap.env", "Boundary Box2D [-90:90 ; -90:90]\nMultibodies\n1\nPassive\nbox.obj 50 0 0 0 0 0\n");
  put("stick.robot", "1\nbox.obj Planar Translational\nConnections\n0\n");
  EXPECT_EQ(read_planning_problem(env).kind, SpaceKind::plane);
  put("other.robot", "1\nbox.obj Planar Rotational\nConnections\n0\n");
  EXPECT_THROW(read_planning_problem(env), InputError);
  put("trap.robot", "1\nbox.obj Planar Rotational\nConnections\n0\n");
  EXPECT_EQ(read_planning_problem(env).kind, SpaceKind::se2);
}

TEST_F(PlanningProblemFiles, ASphereHoldsTheWholeBody) {
  put("cube.obj", box_mesh({-1, -1, -1}, {1, 1, 1}));
  const auto sphere = [&](const std::string& boundary, const std::string& kind) {
    return read_planning_problem(put("a.env", "Boundary " + boundary + "\nMultibodies\n2\nActive\n1\ncube.obj " + kind +
                                                  "\nConnections\n0\nPassive\ncube.obj 1 2 3 0 0 0\n"));
  };
  const PlanningProblem solid = sphere("Sphere [1 -2 3 ; 5]", "Volumetric Translational");
  ASSERT_TRUE(solid.sphere.has_value());
  EXPECT_EQ(solid.sphere->radius, 5);
  expect_near(solid.bounds.min(), Vector3d(-4, -7, -2));
  expect_near(solid.bounds.max(), Vector3d(6, 3, 8));
  // The farthest corner is at distance |(d + 1, 1, 1)| from the centre: within for d = sqrt(23) - 1.
  const double reach = std::sqrt(23.0) - 1;
  EXPECT_TRUE(within_bounds(solid, Vector3d(1 + reach - 1e-6, -2, 3)));
  EXPECT_FALSE(within_bounds(solid, Vector3d(1 + reach + 1e-6, -2, 3)));

  const PlanningProblem flat = sphere("Sphere2D [1 -2 ; 5]", "Planar Rotational");
  expect_near(flat.bounds.max(), Vector3d(6, 3, 0));
  const double planar_reach = std::sqrt(24.0) - 1, turned = 5 - std::sqrt(2.0);
  EXPECT_TRUE(within_bounds(flat, Vector3d(1 + planar_reach - 1e-6, -2, 0)));
  EXPECT_FALSE(within_bounds(flat, Vector3d(1 + planar_reach + 1e-6, -2, 0)));
  EXPECT_TRUE(within_bounds(flat, Vector3d(1 + turned - 1e-6, -2, pi / 4)));
  EXPECT_FALSE(within_bounds(flat, Vector3d(1 + turned + 1e-6, -2, pi / 4)));
}

TEST_F(PlanningProblemFiles, JsonPlacesMeshesAndSweepsPolygons) {
  put_corner_box();
  const PlanningProblem problem = read_planning_problem(put("a.json", R"({
    "about": "three obstacles", "name": "yard", "space": "se3",
    "robot": [{"mesh": "box.obj"}, {"polygon": [[0, 0], [1, 0], [0, 1]], "height": 0.5}],
    "obstacles": [{"mesh": "box.obj", "scale": 2, "pose": {"position": [10, 20, 30], "axis": [0, 0, 5], "degrees": 90}},
                  {"polygon": [[0, 0], [0, 4], [4, 4], [4, 0]], "holes": [[[1, 1], [2, 1], [2, 2], [1, 2]]], "height": 3}],
    "bounds": {"centre": [0, 0, 0], "radius": 50, "hold": "body"},
    "queries": [{"start": [1, 2, 3, -0.5, -0.5, -0.5, -0.5],
                 "goal": {"position": [4, 5, 6], "axis": [1, 0, 0], "degrees": 180}}]})"));
  EXPECT_EQ(problem.name, "yard");
  ASSERT_EQ(problem.robot.size(), 2u);
  expect_near(low(problem.robot[0]), Vector3d(1, 2, 3));  // left as the file has it
  expect_near(high(problem.robot[1]), Vector3d(1, 1, 0.5));
  ASSERT_EQ(problem.obstacles.size(), 2u);
  expect_near(low(problem.obstacles[0]), Vector3d(10 - 12, 20 + 2, 30 + 6));
  EXPECT_NEAR(signed_volume(problem.obstacles[1]), 3 * (16 - 1), 1e-12);
  EXPECT_EQ(problem.sphere->radius, 50);
  EXPECT_TRUE(problem.bounds_hold_body);
  Eigen::VectorXd start(7);
  start << 1, 2, 3, 0.5, 0.5, 0.5, 0.5;
  expect_near(problem.queries[0].start, start);
  expect_pose(problem, problem.queries[0].goal, Vector3d(1, -1, -1).asDiagonal(), {4, 5, 6});
}

TEST_F(PlanningProblemFiles, JsonKeepsPolygonsForAPointInThePlane) {
  put("blocks.wkt", "MULTIPOLYGON (((0 0, 2 0, 2 2, 0 2, 0 0)), ((6 0, 8 0, 8 2, 6 2, 6 0)))");
  put("town.geojson", R"({"type": "Polygon", "coordinates": [[[10, 50], [10.001, 50], [10.001, 50.001], [10, 50]]]})");
  const std::string text = R"({"space": "%", "robot": [#], "obstacles": [{"polygons": "blocks.wkt"},
    {"polygon": [[3, 3], [5, 3], [4, 6]]}, {"city": "town.geojson", "limit": 1}]})";
  const auto with = [&](std::string space, std::string robot) {
    std::string changed = text;
    changed.replace(changed.find('%'), 1, space).replace(changed.find('#'), 1, robot);
    return read_planning_problem(put("a.json", changed));
  };
  const PlanningProblem point = with("plane", "");
  EXPECT_TRUE(point.obstacles.empty());
  ASSERT_EQ(point.footprints.size(), 4u);
  EXPECT_NEAR(area(point.footprints[0]), 4, 1e-12);
  EXPECT_NEAR(area(point.footprints[2]), 3, 1e-12);
  // Half of a thousandth of a degree squared, in metres.
  const double degree = 6371008.8 * pi / 180;
  EXPECT_NEAR(area(point.footprints[3]), 0.5e-6 * degree * degree * std::cos(50.0005 * pi / 180), 1e-3);
  // Without bounds, 5 % of the diagonal is left around the world.
  const Eigen::AlignedBox2d box = bounding_box(point.footprints[3]);
  const Vector3d size(box.sizes().x(), box.sizes().y(), 0);
  EXPECT_NEAR(point.bounds.min().x(), box.min().x() - 0.05 * size.norm(), 1e-9);
  EXPECT_EQ(point.bounds.max().z(), 0);

  const PlanningProblem body = with("se2", R"({"polygon": [[0, 0], [1, 0], [0, 1]]})");
  EXPECT_TRUE(body.footprints.empty());
  ASSERT_EQ(body.obstacles.size(), 4u);
  ASSERT_EQ(body.robot.size(), 1u);
  // The distance of the prisms is that of the polygons: they cover each other's height.
  expect_near(low(body.obstacles[0]), Vector3d(0, 0, -0.5));
  expect_near(low(body.robot[0]), Vector3d(0, 0, -0.5));
}

std::string refusal(const PlanningProblem& problem) {
  try {
    check_problem(problem);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(PlanningProblem, PutTogetherByAProgramIsChecked) {
  PlanningProblem point;
  point.kind = SpaceKind::plane;
  EXPECT_THAT(refusal(point), HasSubstr("obstacles: the world holds no obstacle"));
  point.footprints = {rectangle(0, 0, 3, 4)};
  EXPECT_THAT(refusal(point), HasSubstr("bounds: "));
  point.bounds = usual_bounds(point);
  expect_near(point.bounds.min(), Vector3d(-0.25, -0.25, 0));
  expect_near(point.bounds.max(), Vector3d(3.25, 4.25, 0));
  point.queries = {{Configuration{{-0.2, 0}}, Configuration{{3.2, 4.3}}}};
  EXPECT_THAT(refusal(point), HasSubstr("queries[0].goal: the goal at 3.2, 4.3 lies outside the bounds"));
  point.queries.clear();
  EXPECT_EQ(refusal(point), "");

  PlanningProblem body = point;
  body.kind = SpaceKind::se2;
  EXPECT_THAT(refusal(body), HasSubstr("robot: is missing"));
  body.robot = {box_mesh({0, 0, 0}, {1, 1, 1})};
  EXPECT_THAT(refusal(body), HasSubstr("obstacles: are footprints"));
  body.footprints.clear();
  body.obstacles = {box_mesh({0, 0, 0}, {3, 4, 1})};
  EXPECT_EQ(refusal(body), "");
  body.robot.clear();
  body.kind = SpaceKind::plane;
  EXPECT_THAT(refusal(body), HasSubstr("obstacles: are meshes"));
}

TEST(PlanningProblem, CoordinatesBecomeConfigurations) {
  const std::vector<double> turned{1, 2, 3 * pi / 2}, placed{1, 2, 3, -2e-4, 0, 0, -1};
  expect_near(configuration_of(SpaceKind::se2, turned, "q"), Vector3d(1, 2, -pi / 2));
  expect_near(configuration_of(SpaceKind::space, turned, "q"), Vector3d(1, 2, 3 * pi / 2));
  const Configuration q = configuration_of(SpaceKind::se3, placed, "q");
  EXPECT_NEAR(q.tail<4>().norm(), 1, 1e-15);
  EXPECT_GT(q[3], 0);
  EXPECT_THROW(configuration_of(SpaceKind::plane, turned, "q"), InputError);
  EXPECT_THROW(configuration_of(SpaceKind::plane, std::vector<double>{0, std::nan("")}, "q"), InputError);
  EXPECT_THROW(configuration_of(SpaceKind::se3, std::vector<double>{0, 0, 0, 1, 1, 0, 0}, "q"), InputError);
}

TEST_F(PlanningProblemFiles, OtherFilesGoWithAnEnvironmentOnly) {
  try {
    read_planning_problem(put("a.cfg", "[problem]\n"), {.robot = "stick.robot", .query = {}});
    ADD_FAILURE() << "was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("stick.robot: goes with an .env file only"));
  }
}

}  // namespace
}  // namespace partwise
