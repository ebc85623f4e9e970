#include "partwise/geometry/gltf_accessor.h"

#include <algorithm>

#include "partwise/base/error.h"
#include "partwise/geometry/bytes.h"

namespace partwise {
namespace {

constexpr const char* kExportAgain = "export the file again";

template <typename T>
const T& at(const std::string& file, const std::vector<T>& items, int index, const char* what) {
  if (index < 0 || static_cast<std::size_t>(index) >= items.size()) {
    throw InputError(file, fmt::format("names {} {}, there are {}", what, index, items.size()), kExportAgain);
  }
  return items[static_cast<std::size_t>(index)];
}

bool is_allowed(GltfAccessor::Kind kind, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return true;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return kind == GltfAccessor::Kind::index;
    case TINYGLTF_COMPONENT_TYPE_BYTE:  // KHR_mesh_quantization
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return kind == GltfAccessor::Kind::position;
    default:
      return false;
  }
}

}  // namespace

GltfAccessor::GltfAccessor(const std::string& file, const tinygltf::Model& model, int accessor, Kind kind) {
  const tinygltf::Accessor& source = at(file, model.accessors, accessor, "accessor");
  if (source.sparse.isSparse) {
    throw InputError(file, fmt::format("accessor {} is sparse, which is not supported", accessor),
                     "export it without sparse accessors");
  }
  const int shape = kind == Kind::position ? TINYGLTF_TYPE_VEC3 : TINYGLTF_TYPE_SCALAR;
  if (source.type != shape || !is_allowed(kind, source.componentType)) {
    throw InputError(file,
                     fmt::format("accessor {} is of a type that {} cannot have", accessor,
                                 kind == Kind::position ? "positions" : "indices"),
                     kExportAgain);
  }
  const tinygltf::BufferView& view = at(file, model.bufferViews, source.bufferView, "buffer view");
  const tinygltf::Buffer& buffer = at(file, model.buffers, view.buffer, "buffer");

  type_ = source.componentType;
  normalized_ = source.normalized;
  component_size_ = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type_));
  const std::size_t element = static_cast<std::size_t>(component_size_) * (kind == Kind::position ? 3 : 1);
  stride_ = view.byteStride == 0 ? element : view.byteStride;
  size_ = source.count;
  // Written so that no sum of numbers from the file can overflow.
  const std::size_t bytes = buffer.data.size();
  const bool view_fits = view.byteOffset <= bytes && view.byteLength <= bytes - view.byteOffset;
  const bool start_fits = view_fits && source.byteOffset <= view.byteLength;
  const std::size_t room = start_fits ? view.byteLength - source.byteOffset : 0;
  const bool fits =
      start_fits && stride_ >= element && (size_ == 0 || (room >= element && size_ - 1 <= (room - element) / stride_));
  if (!fits) {
    throw InputError(file,
                     fmt::format("accessor {} of {} elements leaves its buffer of {} bytes", accessor, size_, bytes),
                     "the file was cut short or is wrong: export it again");
  }
  first_ = reinterpret_cast<const char*>(buffer.data.data()) + view.byteOffset + source.byteOffset;
}

double GltfAccessor::component(const char* at) const {
  switch (type_) {  // Normalized integers as section 3.11 of the specification has them.
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return normalized_ ? std::max(load<std::int8_t>(at) / 127.0, -1.0) : load<std::int8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return normalized_ ? load<std::uint8_t>(at) / 255.0 : load<std::uint8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return normalized_ ? std::max(load<std::int16_t>(at) / 32767.0, -1.0) : load<std::int16_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return normalized_ ? load<std::uint16_t>(at) / 65535.0 : load<std::uint16_t>(at);
    default:
      return load<float>(at);
  }
}

Eigen::RowVector3d GltfAccessor::position(std::size_t i) const {
  const char* at = first_ + i * stride_;
  return {component(at), component(at + component_size_), component(at + 2 * component_size_)};
}

std::uint32_t GltfAccessor::index(std::size_t i) const {
  const char* at = first_ + i * stride_;
  switch (type_) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(at);
    default:
      return load<std::uint32_t>(at);
  }
}

}  // namespace partwise
