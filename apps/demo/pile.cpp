#include "pile.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "compound.h"
#include "partwise/appearance/palette.h"
#include "pictures.h"
#include "world.h"

namespace demo {
namespace {

using partwise::Point;
using partwise::PreviewMesh;
using partwise::PreviewScene;

constexpr int steps_a_second = 240;

struct Body {
  std::size_t kind;
  btRigidBody* rigid;
};

double uniform(std::mt19937& random) { return random() / 4294967296.0; }  // the same on every standard library

btQuaternion random_turn(std::mt19937& random) {  // uniform over the rotations (Shoemake 1992)
  const double u = uniform(random), a = 2 * std::numbers::pi * uniform(random),
               b = 2 * std::numbers::pi * uniform(random);
  const double s = std::sqrt(1 - u), c = std::sqrt(u);
  return {static_cast<btScalar>(s * std::sin(a)), static_cast<btScalar>(s * std::cos(a)),
          static_cast<btScalar>(c * std::sin(b)), static_cast<btScalar>(c * std::cos(b))};
}

partwise::Vertices placed(const Compound& compound, const btTransform& pose, const partwise::Vertices& points) {
  partwise::Vertices result(points.rows(), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const btVector3 p = compound.world(pose, points.row(i));
    result.row(i) << p.x(), p.y(), p.z();
  }
  return result;
}

class Heap {
 public:
  Heap(std::span<const PileKind> kinds, const PileSettings& settings) : kinds_(kinds), settings_(settings) {
    for (const PileKind& kind : kinds) compounds_.push_back(make_compound(kind.parts->hulls, 1 / kind.parts->radius));
    // Layers of five around one, the next layer turned; a bounding sphere of 1 m each.
    std::mt19937 random(7);
    for (int i = 0; i < settings.bodies; ++i) {
      const std::size_t kind = static_cast<std::size_t>(i) % kinds.size();
      const int layer = i / 6, place = i % 6;
      const double angle = 2 * std::numbers::pi * place / 5 + 0.9 * layer, out = place == 5 ? 0 : 2.05;
      const btVector3 centre(static_cast<btScalar>(out * std::cos(angle)), static_cast<btScalar>(1.3 + 2.0 * layer),
                             static_cast<btScalar>(out * std::sin(angle)));
      bodies_.push_back({kind, &world_.add(make_body(compounds_[kind], btTransform(random_turn(random), centre)))});
    }
  }

  void run(double until) {
    for (; steps_ < until * steps_a_second; ++steps_) world_.step(btScalar(1) / steps_a_second);
  }

  PreviewScene scene(bool as_hulls) const {
    PreviewScene scene;
    for (const Body& body : bodies_) {
      const Compound& compound = compounds_[body.kind];
      const btTransform& pose = body.rigid->getWorldTransform();
      std::vector<PreviewMesh> meshes;
      if (as_hulls) {
        meshes = hull_meshes(*kinds_[body.kind].parts, 0);
      } else {
        const auto index = static_cast<int>(&body - bodies_.data());
        meshes.push_back({*kinds_[body.kind].mesh, {}, partwise::part_colour(index % 12)});
      }
      for (PreviewMesh& mesh : meshes) {
        mesh.mesh.vertices = placed(compound, pose, mesh.mesh.vertices);
        scene.meshes.push_back(std::move(mesh));
      }
    }
    return scene;
  }

  double fastest() const {
    btScalar speed = 0;
    for (const Body& body : bodies_) speed = std::max(speed, body.rigid->getLinearVelocity().length());
    return speed;
  }

  int hulls() const {
    int count = 0;
    for (const Body& body : bodies_) count += kinds_[body.kind].parts->parts();
    return count;
  }

 private:
  std::span<const PileKind> kinds_;
  const PileSettings settings_;
  std::vector<Compound> compounds_;  // outlive the world's bodies
  World world_;
  std::vector<Body> bodies_;
  int steps_ = 0;
};

// The viewer stands still while the bodies fall: the camera sees the heap as it will be and a column above it.
partwise::PreviewCamera camera_for(const PreviewScene& heap, double column, double aspect) {
  PreviewScene framed = heap;
  if (column > 0) {
    PreviewMesh top;
    top.mesh.vertices = Point(0, column, 0);
    framed.meshes.push_back(top);
  }
  partwise::PreviewView view;
  view.azimuth = 30;
  view.elevation = 24;
  view.fill = 0.94;
  return frame_scene(framed, view, aspect);
}

}  // namespace

Pile simulate_pile(std::span<const PileKind> kinds, const PileSettings& settings) {
  using Clock = std::chrono::steady_clock;
  Heap heap(kinds, settings);
  Pile pile;
  pile.hulls = heap.hulls();
  const auto run = [&](double until) {
    const auto start = Clock::now();
    heap.run(until);
    pile.seconds += std::chrono::duration<double>(Clock::now() - start).count();
  };
  std::vector<PreviewScene> falling;
  for (const double time : settings.frames) {
    run(time);
    falling.push_back(heap.scene(false));
  }
  run(settings.seconds);
  pile.fastest = heap.fastest();

  const PreviewScene as_meshes = heap.scene(false), as_hulls = heap.scene(true);
  for (const PreviewMesh& hull : as_hulls.meshes) {
    pile.deepest = std::max(pile.deepest, -hull.mesh.vertices.col(1).minCoeff());
  }
  const partwise::PreviewCamera fall_camera =
      camera_for(as_meshes, 7, static_cast<double>(settings.width) / settings.height);
  for (PreviewScene& scene : falling) {
    pile.frames.push_back(render_preview(scene, fall_camera, {settings.width, settings.height, 2}));
  }
  const partwise::PreviewCamera heap_camera = camera_for(as_meshes, 0, 2.0 * settings.width / settings.height);
  pile.heap = render_preview(as_meshes, heap_camera, {2 * settings.width, settings.height, 2});
  pile.heap_hulls = render_preview(as_hulls, heap_camera, {2 * settings.width, settings.height, 2});
  return pile;
}

}  // namespace demo
