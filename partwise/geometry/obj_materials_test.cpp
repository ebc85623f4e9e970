#include <gmock/gmock.h>

#include "partwise/base/error.h"
#include "partwise/geometry/mesh_io.h"

namespace partwise {
namespace {

TEST(ObjMaterials, NameWhatEachTriangleWears) {
  constexpr char bytes[] =
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 0.5 0\n"
      "f 1 2 3\nusemtl dark  oak\nf 1 2 3 4 5 # three triangles\nusemtl b\nusemtl c\nf 1 2 \\\n 3 4\nusemtl dark "
      "oak\nf 1 2 3\n";
  const FaceMaterials worn = read_obj_materials("a.obj", bytes);
  EXPECT_THAT(worn.names, testing::ElementsAre("", "dark oak", "c"));
  EXPECT_THAT(worn.of_face, testing::ElementsAre(0, 1, 1, 1, 2, 2, 1));
  EXPECT_EQ(read_mesh("a.obj", bytes).faces.rows(), 7);
}

TEST(ObjMaterials, AreMissed) {
  EXPECT_THROW(read_obj_materials("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"), InputError);
}

}  // namespace
}  // namespace partwise
