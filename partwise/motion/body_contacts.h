// What the field learns from where the robot has a body (Liu 2017, section 5.5.1): configurations at which it touches
// an obstacle, or alternatively ones at which it is in collision with it, each with the obstacle's number.
//
// For each of some rotations, spread evenly over the group (one where the robot does not turn), and each pair of convex
// bodies, one of the robot and one of an obstacle, the Minkowski sum of the obstacle and the reflected body is the set
// of positions at which the two overlap; its surface, sampled evenly by area (in the plane by length), is contact. What
// lies inside another sum of the same obstacle is dropped, for there the robot is in collision with that obstacle by
// another part; what lies inside a sum of another obstacle still teaches. Rotations of space are a super-Fibonacci
// spiral (Alexa 2022), whose points are about equally far from each other.
//
// In the plane hulls count by their outlines along z. Hulls with very many vertices are simplified from outside, which
// keeps sums quick. The same for any number of threads. Errors: CheckFailed for another number of hulls and obstacle
// numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/geometry/mesh.h"
#include "partwise/motion/contact_samples.h"

namespace partwise {

enum class ContactSource { contact, collision };  // on the surface of sums, or inside, as deep as 0.3 of the way in

struct BodyContactSettings {
  ContactSource source = ContactSource::contact;
  int samples = 300;            // an obstacle, before any is dropped; training takes about their square
  int most_samples = 12000;     // of all obstacles, which have fewer each, at fewer rotations, if there are many
  int rotations = 100;          // among which they are shared out, and there among sums by their size
  int most_hull_vertices = 24;  // of a hull; 0: any
};

// hulls[i], convex, belongs to obstacles[i]; `robot` are the convex bodies in its frame.
ContactSamples body_contacts(const ConfigurationSpace& space, const std::vector<Mesh>& robot,
                             const std::vector<Mesh>& hulls, const std::vector<int>& obstacles,
                             const BodyContactSettings& settings = {}, const Progress& progress = {});

// `count` rotations, spread evenly, as configurations at the origin of the space; one where it does not turn.
std::vector<Configuration> spread_rotations(const ConfigurationSpace& space, int count);

}  // namespace partwise
