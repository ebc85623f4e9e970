// A stick through a window, by OMPL: planner SVMA, then OMPL's own PRM on states of the medial axis.
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/prm/PRM.h>

#include <iostream>
#include <memory>

#include "partwise/motion/ompl/ompl_scene.h"
#include "partwise/motion/ompl/svma_planner.h"
#include "partwise/motion/ompl/svma_sampler.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: example_ompl_plan PROBLEM\n";
    return 2;
  }
  const partwise::PlanningProblem problem = partwise::read_planning_problem(argv[1]);
  const partwise::ProblemScene world = partwise::problem_scene(problem);
  const partwise::ConfigurationSpace& space = world.scene->space();

  ompl::geometric::SimpleSetup setup(partwise::space_information(world.scene));
  ompl::base::ScopedState<> start(setup.getSpaceInformation()), goal(setup.getSpaceInformation());
  partwise::write_state(space, problem.queries.at(0).start, start.get());
  partwise::write_state(space, problem.queries.at(0).goal, goal.get());
  setup.setStartAndGoalStates(start, goal);

  setup.setPlanner(std::make_shared<partwise::SVMA>(setup.getSpaceInformation(), world));
  if (setup.solve(30.0) != ompl::base::PlannerStatus::EXACT_SOLUTION) return 1;
  partwise::simplify(setup.getSolutionPath(), *world.scene);
  const partwise::MotionPath path = partwise::motion_path(space, setup.getSolutionPath());
  std::cout << "SVMA: length " << partwise::path_length(space, path) << ", clearance "
            << partwise::path_clearance(*world.scene, path).minimum << "\n";

  setup.clear();
  const std::shared_ptr<const partwise::Retractor> push =
      partwise::trained_push(*world.scene, world.contacts(partwise::Progress{}));
  setup.getSpaceInformation()->setValidStateSamplerAllocator(partwise::svma_sampler_allocator(world.scene, push));
  setup.setPlanner(std::make_shared<ompl::geometric::PRM>(setup.getSpaceInformation()));
  if (setup.solve(30.0) != ompl::base::PlannerStatus::EXACT_SOLUTION) return 1;
  std::cout << "PRM on the axis: length " << setup.getSolutionPath().length() << "\n";
  return 0;
}
