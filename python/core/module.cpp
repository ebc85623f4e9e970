// The extension module partwise._core: all of the package but what needs libtorch. python/partwise/_core.pyi says what
// it holds.
#include "bindings.h"
#include "errors.h"

PYBIND11_MODULE(_core, core) {
  using namespace partwise::python;
  add_errors(core);
  translate_errors(core);
  add_meshes(core);
  add_solid_parts(core);
  add_surface_parts(core);
  add_applications(core);
  add_nets(core);
  add_retrieval(core);
  add_outlines(core);
  add_images(core);
  add_materials(core);
  add_rendering(core);
  add_normals(core);
  add_motion(core);
  add_problems(core);
  add_paths(core);
}
