// A scene as OMPL (the Open Motion Planning Library) sees it.
//
//   plane, space  RealVectorStateSpace of 2 or 3 dimensions
//   se2           SE2StateSpace
//   se3           SE3StateSpace; OMPL's quaternions are x y z w, ours w x y z
//
// Rotations are weighted by the robot's size, so that OMPL's distance between two states is the displacement
// (configuration_space.h). States are valid where the robot is free and within its bounds; their clearance is the
// distance from the nearest obstacle. Motions are valid by certificate (free_motion.h), not by checks every so often.
//
// Errors: ompl::Exception for states of another space, by OMPL's own checks.
#pragma once

#include <ompl/base/SpaceInformation.h>
#include <ompl/geometric/PathGeometric.h>

#include <memory>

#include "partwise/motion/motion_path.h"
#include "partwise/motion/path_simplify.h"

namespace partwise {

ompl::base::StateSpacePtr state_space(const ConfigurationSpace& space);

Configuration configuration_of(const ConfigurationSpace& space, const ompl::base::State* state);
void write_state(const ConfigurationSpace& space, const Configuration& q, ompl::base::State* state);

// With validity and motions decided by the scene, which it shares; set up.
ompl::base::SpaceInformationPtr space_information(std::shared_ptr<const Scene> scene);

std::shared_ptr<ompl::geometric::PathGeometric> geometric_path(const ompl::base::SpaceInformationPtr& si,
                                                               const ConfigurationSpace& space, const MotionPath& path);
MotionPath motion_path(const ConfigurationSpace& space, const ompl::geometric::PathGeometric& path);

// Shortened without losing clearance (path_simplify.h), in place of OMPL's PathSimplifier, which spends it.
void simplify(ompl::geometric::PathGeometric& path, const Scene& scene, const PathSimplifySettings& settings = {});

}  // namespace partwise
