// What libFuzzer calls: one reader of meshes, chosen by PARTWISE_FUZZ_FORMAT, or that of catalogues of models with the
// meshes in them. Whatever the bytes, the outcome is a mesh whose faces name vertices that are there, all of them
// finite, or an InputError of one line.
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "fuzz/outcome.h"
#include "partwise/appearance/shapes/model_archive.h"
#include "partwise/geometry/mesh_io.h"

namespace {

using namespace partwise;
using namespace partwise::fuzz;

constexpr std::string_view format = PARTWISE_FUZZ_FORMAT;

void expect_whole(const Mesh& mesh) {
  if (mesh.faces.rows() == 0) give_up("a mesh without faces");
  if (!mesh.vertices.allFinite()) give_up("a vertex that is not finite");
  if (mesh.faces.minCoeff() < 0 || mesh.faces.maxCoeff() >= mesh.vertices.rows()) give_up("a face of no vertices");
}

// Archives are read from files only: one in memory.
class FileOfBytes {
 public:
  explicit FileOfBytes(std::string_view bytes) : descriptor_(memfd_create("fuzz", 0)) {
    if (write(descriptor_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) give_up("no file");
  }
  ~FileOfBytes() { close(descriptor_); }
  FileOfBytes(const FileOfBytes&) = delete;
  FileOfBytes& operator=(const FileOfBytes&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

void read_archive(std::string_view bytes) {
  const FileOfBytes file(bytes);
  expect_message_or([&] {
    const ModelArchive archive(file.path());
    for (std::size_t i = 0; i < archive.models().size() && i < 3; ++i)
      expect_message_or([&] { expect_whole(archive.read(archive.models()[i].id)); });
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (format == "sh3f") {
    read_archive(bytes);
  } else {
    expect_message_or([&] { expect_whole(read_mesh("fuzz." + std::string(format), bytes)); });
  }
  return 0;
}
