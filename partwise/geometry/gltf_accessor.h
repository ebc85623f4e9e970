// Numbers of a glTF accessor, with every range checked against the buffer once, at construction.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>

#include "partwise/geometry/tinygltf_config.h"

namespace partwise {

class GltfAccessor {
 public:
  enum class Kind { position, index };

  // InputError when the accessor does not exist, is sparse, leaves its buffer, or is of no type that `kind` may have.
  GltfAccessor(const std::string& file, const tinygltf::Model& model, int accessor, Kind kind);

  std::size_t size() const { return size_; }
  Eigen::RowVector3d position(std::size_t i) const;
  std::uint32_t index(std::size_t i) const;

 private:
  double component(const char* at) const;

  const char* first_ = nullptr;
  std::size_t size_ = 0;
  std::size_t stride_ = 0;
  int type_ = 0;            // TINYGLTF_COMPONENT_TYPE_*
  int component_size_ = 0;  // bytes
  bool normalized_ = false;
};

}  // namespace partwise
