// partwise.Problem: a rigid robot, obstacles, where the robot may be, and where it should go.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "partwise/motion/planning_problem.h"

namespace partwise::python {

namespace py = pybind11;

// A problem of Python's never changes, so that long calls may read it without the interpreter's lock.
using SharedProblem = std::shared_ptr<PlanningProblem>;

// Errors: InputError "problem" for what is none.
SharedProblem problem_in(const py::handle& given);

// A number of the problem's queries from 0, or a pair of start and goal, each the coordinates of its space. Errors:
// InputError "query", for a pair that is outside of the bounds as well.
MotionQuery query_in(const py::handle& given, const PlanningProblem& problem);

}  // namespace partwise::python
