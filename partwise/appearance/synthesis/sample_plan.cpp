#include "partwise/appearance/synthesis/sample_plan.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>

#include "partwise/base/draw.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

// What a random number is for.
enum class Purpose : std::uint64_t { shape, light, turn, material, view };

void check(const SamplePlan& plan) {
  for (const auto& [name, count] :
       {std::pair{"shapes", plan.shapes}, {"materials", plan.materials}, {"lights", plan.lights}}) {
    if (count < 1) throw InputError(name, "there are none to draw from", "name one or more");
  }
  if (plan.views < 1 || plan.views > plan.viewpoints) {
    throw InputError("views", fmt::format("{} of {} viewpoints", plan.views, plan.viewpoints),
                     "give 1 or more, at most as many as viewpoints");
  }
}

}  // namespace

Sample sample(const SamplePlan& plan, std::uint64_t number) {
  check(plan);
  const auto views = static_cast<std::uint64_t>(plan.views);
  const std::uint64_t combination = number / views;
  const auto draw = [&](Purpose purpose) { return Draw(plan.seed, combination, static_cast<std::uint64_t>(purpose)); };
  Sample result;
  result.shape = draw(Purpose::shape).below(plan.shapes);
  result.light = draw(Purpose::light).below(plan.lights);
  result.light_turn = 2 * std::numbers::pi * draw(Purpose::turn).unit();
  result.viewpoint = draw(Purpose::view).different(plan.views, plan.viewpoints)[number % views];
  Draw material = draw(Purpose::material);
  const int parts = plan.parts(result.shape);
  while (static_cast<int>(result.materials.size()) < parts) {
    const int missing = parts - static_cast<int>(result.materials.size());
    for (const int each : material.different(std::min(missing, plan.materials), plan.materials))
      result.materials.push_back(each);
  }
  return result;
}

}  // namespace partwise
