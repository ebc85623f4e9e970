// The meshes that ship with the project, with what the page says about them.
#pragma once

#include <span>
#include <string_view>

namespace demo {

struct Model {
  std::string_view file;  // in data/models
  std::string_view name;
  std::string_view author;
  std::string_view licence;
  double azimuth;        // degrees: from where it is best seen
  bool in_hero = false;  // it is in the one picture that stands for all
  bool in_herd = false;  // an animal, whose silhouette is in the crowd
};

std::span<const Model> models();

}  // namespace demo
