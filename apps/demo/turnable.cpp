#include "turnable.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <vector>

#include "page_assets.h"
#include "partwise/appearance/camera.h"
#include "partwise/base/read_bytes.h"
#include "partwise/geometry/mesh_io.h"

namespace demo {
namespace {

using partwise::Point;

// The upright cylinder about them, as two rings of points.
partwise::Vertices cylinder_of(std::span<const partwise::Vertices* const> shapes, const Eigen::AlignedBox3d& box) {
  const Point centre = box.center().transpose();
  double radius = 0;
  for (const partwise::Vertices* points : shapes) {
    for (const auto& p : points->rowwise())
      radius = std::max(radius, std::hypot(p.x() - centre.x(), p.z() - centre.z()));
  }
  constexpr int corners = 32;
  partwise::Vertices rings(2 * corners, 3);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const Point around = centre + radius * Point(std::cos(angle), 0, std::sin(angle));
    rings.row(2 * i) << around.x(), box.min().y(), around.z();
    rings.row(2 * i + 1) << around.x(), box.max().y(), around.z();
  }
  return rings;
}

constexpr std::string_view name_of(Slider slider) {
  return slider == Slider::apart ? "apart" : slider == Slider::between ? "between" : "along";
}

}  // namespace

Turnable make_turnable(const partwise::PreviewScene& still, std::span<const partwise::NamedMesh> meshes,
                       const Turning& turning, std::string caption, std::string description) {
  std::vector<const partwise::Vertices*> shapes;
  for (const partwise::PreviewMesh& each : still.meshes) shapes.push_back(&each.mesh.vertices);
  for (const partwise::NamedMesh& each : meshes) shapes.push_back(&each.mesh.vertices);
  Eigen::AlignedBox3d box;
  for (const partwise::Vertices* points : shapes) {
    for (const auto& p : points->rowwise()) box.extend(p.transpose());
  }
  const partwise::Vertices rings = cylinder_of(shapes, box);
  const partwise::RoundPoints framed{&rings, 0};
  const partwise::Camera camera =
      partwise::frame_points({&framed, 1}, {.azimuth = turning.azimuth, .elevation = turning.elevation, .fill = 1},
                             static_cast<double>(turning.width) / turning.height);
  const Point back = camera.axes.row(2);
  const Point about = camera.position - back * (camera.position - Point(box.center().transpose())).dot(back);
  const partwise::Image picture = render_preview(still, camera, {.width = turning.width, .height = turning.height});
  return {make_picture(picture, std::move(caption), std::move(description)),
          encode_glb(meshes),
          fmt::format("{:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g}", camera.position.x(), camera.position.y(),
                      camera.position.z(), about.x(), about.y(), about.z()),
          turning.slider,
          turning.label,
          turning.start};
}

std::string figure(const Turnable& model, std::string_view id) {
  std::string html = fmt::format(
      "<figure class=\"turn\" id=\"{0}\" data-camera=\"{1}\" data-slider=\"{2}\">\n<div class=\"view\">{3}</div>\n"
      "<div class=\"controls\" hidden><label>{4} <input type=\"range\" min=\"0\" max=\"1\" step=\"0.01\" "
      "value=\"{5}\"></label>",
      id, model.camera, name_of(model.slider), image(model.still), model.label, model.start);
  if (model.slider == Slider::apart) html += "<label><input type=\"checkbox\"> hulls</label>";
  return html + fmt::format(
                    "</div>\n<figcaption>{}</figcaption>\n"
                    "<script type=\"application/octet-stream\">{}</script>\n</figure>\n",
                    model.still.caption, base64(model.glb));
}

std::string viewer_scripts() {
  const std::filesystem::path three = PARTWISE_DEMO_THREE;
  std::string html = fmt::format("<!--\n{}-->\n", three_licence);
  for (const char* file : {"three.min.js", "examples/js/loaders/GLTFLoader.js"})
    html +=
        fmt::format("<script type=\"text/plain\" class=\"three\">\n{}</script>\n", partwise::read_bytes(three / file));
  return html + fmt::format("<script>\n{}</script>\n", viewer_script);
}

}  // namespace demo
