#include "partwise/motion/margin_push.h"

#include <algorithm>
#include <cmath>

namespace partwise {

struct MarginPush::Walk {
  Retraction result;
  std::array<int, 2> pair = {-1, -1};
  int changes = 0;  // of the pair

  void on(std::array<int, 2> next) {
    if (next[0] > next[1]) std::swap(next[0], next[1]);
    if (pair[0] >= 0 && next != pair) ++changes;
    pair = next;
  }
  double damping() const { return 1 / (1 + 0.5 * std::max(0, changes - 2)); }
};

MarginPush::MarginPush(const Scene& scene, const MarginField& field, const MarginPushSettings& settings)
    : scene_(scene), field_(field), settings_(settings) {}

void MarginPush::by_score(Walk& walk) const {
  constexpr double vanished = 1e-6;  // of the gradient, a kernel's width
  const ConfigurationSpace& space = scene_.space();
  const int most = settings_.step == StepSize::combined ? (3 * settings_.most_steps + 9) / 10 : settings_.most_steps;
  for (; walk.result.steps < most; ++walk.result.steps) {
    const MotionVector x = space.embedded(walk.result.q);
    walk.on(field_.nearest_two(x));
    const MarginClassifier& classifier = field_.between(walk.pair[0], walk.pair[1]);
    const FieldValue f = classifier.at(x);
    if (std::abs(f.value) <= settings_.epsilon) {
      walk.result.done = true;
      return;
    }
    const Tangent gradient = space.pulled_back(walk.result.q, f.gradient);
    const double slope = gradient.norm();
    if (slope * classifier.width() < vanished) return;
    const double length = std::clamp(f.value / slope, -classifier.width(), classifier.width());
    walk.result.q = space.moved(walk.result.q, -walk.damping() * length / slope * gradient);
  }
}

// The two nearest of all obstacles instead of those that the field names. False where the robot is not free, or where
// they are the same again.
bool MarginPush::look_around(Walk& walk, const AxisState& state) const {
  const std::array<int, 2> before = walk.pair;
  if (!state.free || state.pair[1].obstacle < 0) return false;
  walk.on({state.pair[0].obstacle, state.pair[1].obstacle});
  return walk.pair != before;
}

void MarginPush::by_clearance(Walk& walk) const {
  const ConfigurationSpace& space = scene_.space();
  const auto state_at = [&](const Configuration& q) {
    ++walk.result.distance_queries;
    ++walk.result.collision_checks;
    return axis_state(scene_, q);
  };
  bool known = false;  // the pair is that of all distances, not of the field
  for (; walk.result.steps < settings_.most_steps; ++walk.result.steps) {
    Configuration& q = walk.result.q;
    const MotionVector x = space.embedded(q);
    if (!known) walk.on(field_.nearest_two(x));
    const Near a = scene_.distance(q, walk.pair[0]), b = scene_.distance(q, walk.pair[1]);
    walk.result.distance_queries += 2;
    const double difference = a.distance - b.distance;
    const Tangent apart = a.gradient - b.gradient;
    const bool told_apart = apart.norm() >= least_separation;
    if (!told_apart || std::abs(difference) <= settings_.epsilon * std::min(a.distance, b.distance)) {
      const AxisState state = state_at(q);
      if (state.on_axis(settings_.epsilon)) {
        // What is known by now gives one more step, straight across the axis, whose error is of second order.
        const Tangent across = state.pair[1].gradient - state.pair[0].gradient;
        q = space.moved(q, -state.imbalance() / across.squaredNorm() * across);
        walk.result.done = true;
        return;
      }
      if (!look_around(walk, state)) return;
      known = true;
      continue;
    }
    const FieldValue f = field_.between(walk.pair[0], walk.pair[1]).at(x);
    Tangent along = space.pulled_back(q, f.gradient);
    const double steepness = along.norm();
    if (steepness > 0) along /= steepness;
    double slope = along.dot(apart);  // f grows towards the first obstacle
    if (std::abs(slope) < 0.5 * apart.norm()) {
      slope = apart.norm();
      along = apart / slope;
    }
    const double reach = std::max(a.distance, b.distance);
    const double length = std::clamp(difference / slope, -reach, reach);
    q = space.moved(q, -walk.damping() * length * along);
  }
}

Retraction MarginPush::operator()(const Configuration& q, Draw& /*draw*/) const {
  Walk walk;
  walk.result.q = q;
  if (settings_.step != StepSize::clearance) by_score(walk);
  if (settings_.step != StepSize::score) {
    walk.result.done = false;
    by_clearance(walk);
  }
  return walk.result;
}

namespace {

class TrainedPush final : public Retractor {
 public:
  TrainedPush(const Scene& scene, const ContactSamples& contacts, const MarginFieldSettings& field,
              const MarginPushSettings& push, const Progress& progress)
      : field_(scene.space(), contacts, field, progress), push_(scene, field_, push) {}

  Retraction operator()(const Configuration& q, Draw& draw) const override { return push_(q, draw); }

 private:
  MarginField field_;
  MarginPush push_;
};

}  // namespace

std::unique_ptr<Retractor> trained_push(const Scene& scene, const ContactSamples& contacts,
                                        const MarginFieldSettings& field, const MarginPushSettings& push,
                                        const Progress& progress) {
  return std::make_unique<TrainedPush>(scene, contacts, field, push, progress);
}

}  // namespace partwise
