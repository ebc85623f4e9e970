// Shapes in the plane as a scanner would see them: silhouettes painted onto a grid of pixels, ragged edges and specks
// by seeded noise, and the outlines of what results.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/polygon.h"

namespace demo {

class Scan {
 public:
  Scan(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  // Paints what an odd number of rings encloses; pixel coordinates, y down.
  void paint(std::span<const partwise::Ring> rings);
  // Paints the silhouette of a mesh, turned about the vertical axis to where it is widest, its feet at (x, y).
  void paint_silhouette(const partwise::Mesh& mesh, double x, double y, double height, bool mirrored);

  // Edges wander by up to `edge` pixels or so, and up to `specks` holes of 2.5 to 5 pixels appear, clear of everything
  // else.
  void roughen(double edge, int specks, std::uint64_t seed);

  partwise::Polygons outlines() const;

 private:
  float& at(int x, int y) { return values_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + x]; }
  float at(int x, int y) const { return values_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + x]; }
  void blur(int radius);
  bool is_full(double x, double y, double radius) const;

  int width_, height_;
  std::vector<float> values_;
};

}  // namespace demo
