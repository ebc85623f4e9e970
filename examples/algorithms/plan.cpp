// A path that keeps away from obstacles, from a problem's first start to its first goal: plan PROBLEM
#include <partwise/motion/axis_path.h>
#include <partwise/motion/path_simplify.h>

#include <iostream>

int main(int, char** argv) {
  const partwise::PlanningProblem problem = partwise::read_planning_problem(argv[1]);
  const partwise::ProblemScene world = partwise::problem_scene(problem);
  const auto found = partwise::axis_path(world, problem.queries.at(0), {.seconds = 60});
  if (!found) return 1;
  const partwise::MotionPath path = partwise::simplified(*world.scene, found->path);
  std::cout << "length " << partwise::path_length(world.scene->space(), path) << ", at least "
            << partwise::path_clearance(*world.scene, path).minimum << " from everything\n";
}
