#include "pile.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <ctime>
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

constexpr int steps_a_second = 120, released_together = 4;

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

double core_seconds() {  // that this thread has used
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

class Heap {
 public:
  Heap(std::span<const PileKind> kinds, const PileSettings& settings) : kinds_(kinds), settings_(settings) {
    for (const PileKind& kind : kinds) compounds_.push_back(make_compound(kind.parts->hulls, 1 / kind.parts->radius));
  }

  void run(double until) {
    for (; steps_ < until * steps_a_second; ++steps_) {
      const std::size_t releases = bodies_.size() / released_together;
      if (bodies_.size() < static_cast<std::size_t>(settings_.bodies) &&
          steps_ >= settings_.interval * static_cast<double>(releases) * steps_a_second) {
        release();
      }
      world_.step(btScalar(1) / steps_a_second);
    }
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

  int hulls() const {
    int count = 0;
    for (const Body& body : bodies_) count += kinds_[body.kind].parts->parts();
    return count;
  }

 private:
  // Bodies in a ring that their bounding spheres, of 1 m, do not leave, high above the heap and on their way down.
  void release() {
    for (int i = 0; i < released_together && bodies_.size() < static_cast<std::size_t>(settings_.bodies); ++i) {
      const std::size_t kind = bodies_.size() % kinds_.size();
      const double angle = 2 * std::numbers::pi * i / released_together + 0.9 * static_cast<double>(bodies_.size());
      const btVector3 place(static_cast<btScalar>(1.45 * std::cos(angle)), 8,
                            static_cast<btScalar>(1.45 * std::sin(angle)));
      btRigidBody& rigid = world_.add(make_body(compounds_[kind], btTransform(random_turn(random_), place)));
      rigid.setLinearVelocity({0, -3, 0});
      bodies_.push_back({kind, &rigid});
    }
  }

  std::span<const PileKind> kinds_;
  const PileSettings settings_;
  std::mt19937 random_{7};
  std::vector<Compound> compounds_;  // outlive the world's bodies
  World world_;
  std::vector<Body> bodies_;
  int steps_ = 0;
};

// Looks at the whole heap; only what rolled away, twice as far from its axis as nine tenths of the bodies are, may
// leave the picture. With `column` the view also holds that height above the floor, from which bodies fall.
partwise::PreviewCamera camera_for(const PreviewScene& heap, double column, double aspect) {
  std::vector<std::pair<double, std::size_t>> by_distance;
  for (std::size_t i = 0; i < heap.meshes.size(); ++i) {
    const Point middle = heap.meshes[i].mesh.vertices.colwise().mean();
    by_distance.emplace_back(std::hypot(middle.x(), middle.z()), i);
  }
  std::sort(by_distance.begin(), by_distance.end());
  PreviewScene framed;
  const double far = by_distance.empty() ? 0 : 2 * by_distance[(by_distance.size() * 9 - 1) / 10].first;
  for (const auto& [distance, index] : by_distance) {
    if (distance <= far) framed.meshes.push_back(heap.meshes[index]);
  }
  if (column > 0) framed.meshes.emplace_back().mesh.vertices = Point(0, column, 0);
  partwise::PreviewView view;
  view.azimuth = 30;
  view.elevation = 18;
  view.fill = 0.84;
  return frame_scene(framed, view, aspect);
}

}  // namespace

Pile simulate_pile(std::span<const PileKind> kinds, const PileSettings& settings) {
  Heap heap(kinds, settings);
  Pile pile;
  const double start = core_seconds();
  for (const double time : settings.frames) {
    heap.run(time);
    pile.falling.push_back(heap.scene(false));
  }
  heap.run(settings.seconds);
  pile.seconds = core_seconds() - start;
  pile.hulls = heap.hulls();
  pile.heap = heap.scene(false);
  pile.heap_hulls = heap.scene(true);
  for (const PreviewMesh& hull : pile.heap_hulls.meshes) {
    pile.deepest = std::max(pile.deepest, -hull.mesh.vertices.col(1).minCoeff());
  }
  return pile;
}

PilePictures draw_pile(const Pile& pile, const PileSettings& settings) {
  PilePictures pictures;
  const partwise::PreviewSettings fall{settings.width, settings.height};
  const partwise::PreviewCamera fall_camera = camera_for(pile.heap, 9.2, static_cast<double>(fall.width) / fall.height);
  for (const PreviewScene& scene : pile.falling) pictures.falling.push_back(render_preview(scene, fall_camera, fall));
  const partwise::PreviewSettings rest{settings.heap_width, settings.heap_height};
  const partwise::PreviewCamera heap_camera = camera_for(pile.heap, 0, static_cast<double>(rest.width) / rest.height);
  pictures.heap = render_preview(pile.heap, heap_camera, rest);
  pictures.heap_hulls = render_preview(pile.heap_hulls, heap_camera, rest);
  return pictures;
}

}  // namespace demo
