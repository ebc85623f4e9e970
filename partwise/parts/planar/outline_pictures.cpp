#include "partwise/parts/planar/outline_pictures.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <vector>

#include "partwise/base/atomic_file.h"

namespace partwise {
namespace {

constexpr std::array colours{"#8ecae6", "#ffb703", "#b7e4c7", "#f4978e", "#cdb4db", "#ffd6a5",
                             "#90be6d", "#f9c6d7", "#a8dadc", "#e9c46a", "#b8c0ff", "#d4a373"};

// The sheet: where the shape's coordinates go.
class Sheet {
 public:
  Sheet(std::span<const Polygon> shape, const PictureSettings& settings)
      : box_(bounding_box(shape)), down_(settings.y_down), ground_(settings.ground) {
    const double longer = std::max(box_.sizes().maxCoeff(), 1e-300);
    scale_ = settings.size * 0.94 / longer;
    margin_ = settings.size * 0.03;
  }

  std::string head() const {
    const Eigen::Vector2d size = scale_ * box_.sizes() + Eigen::Vector2d::Constant(2 * margin_);
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.2f} "
        "{1:.2f}\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n{2}",
        size.x(), size.y(), ground_ ? "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" : "");
  }

  std::string point(const Eigen::Vector2d& p) const {
    const double x = margin_ + scale_ * (p.x() - box_.min().x());
    const double y = margin_ + scale_ * (down_ ? p.y() - box_.min().y() : box_.max().y() - p.y());
    return fmt::format("{:.2f} {:.2f}", x, y);
  }

  std::string line(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
    return fmt::format("M{}L{}", point(a), point(b));
  }

  std::string path(const Polygon& polygon) const {
    std::string data = ring(polygon.outer);
    for (const Ring& hole : polygon.holes) data += ring(hole);
    return data;
  }

 private:
  std::string ring(const Ring& ring) const {
    std::string data;
    for (Eigen::Index i = 0; i < ring.rows(); ++i) {
      data += i == 0 ? 'M' : 'L';
      data += point(ring.row(i).transpose());
    }
    data += 'Z';
    return data;
  }

  Eigen::AlignedBox2d box_;
  double scale_ = 1, margin_ = 0;
  bool down_, ground_;
};

// A colour a part, none that a neighbour has where the palette suffices; used colours take turns.
std::vector<std::size_t> colour_parts(const Outline& outline) {
  std::vector<std::set<int>> neighbours(outline.parts.size());
  for (const OutlineCut& cut : outline.cuts) {
    neighbours[cut.left].insert(cut.right);
    neighbours[cut.right].insert(cut.left);
  }
  std::vector<std::size_t> colour(outline.parts.size(), colours.size());
  for (std::size_t p = 0; p < colour.size(); ++p) {
    std::set<std::size_t> taken;
    for (int q : neighbours[p]) taken.insert(colour[q]);
    colour[p] = p % colours.size();
    for (std::size_t tries = 0; tries < colours.size() && taken.contains(colour[p]); ++tries) {
      colour[p] = (colour[p] + 1) % colours.size();
    }
  }
  return colour;
}

}  // namespace

std::string outline_svg(const Outline& outline, const PictureSettings& settings) {
  const Sheet sheet(outline.parts, settings);
  const std::vector<std::size_t> colour = colour_parts(outline);
  std::string text = sheet.head();
  for (std::size_t p = 0; p < outline.parts.size(); ++p) {
    fmt::format_to(std::back_inserter(text),
                   "<path fill=\"{0}\" fill-rule=\"evenodd\" stroke=\"#33415c\" stroke-width=\"0.8\" d=\"{1}\"/>\n",
                   colours[colour[p]], sheet.path(outline.parts[p]));
  }
  std::string cuts;
  for (const OutlineCut& cut : outline.cuts) cuts += sheet.line(cut.a, cut.b);
  if (!cuts.empty()) text += "<path fill=\"none\" stroke=\"#b5172f\" stroke-width=\"2\" d=\"" + cuts + "\"/>\n";
  return text + "</svg>\n";
}

void write_outline_svg(const std::filesystem::path& path, const Outline& outline, const PictureSettings& settings) {
  write_file(path, outline_svg(outline, settings));
}

std::string skeleton_svg(std::span<const Polygon> shape, const Skeleton& skeleton, const PictureSettings& settings) {
  const Sheet sheet(shape, settings);
  std::string text = sheet.head();
  for (const Polygon& polygon : shape) {
    text += "<path fill=\"#e3ebf3\" fill-rule=\"evenodd\" stroke=\"#8d99ae\" stroke-width=\"1\" d=\"" +
            sheet.path(polygon) + "\"/>\n";
  }
  std::string bones;
  for (const auto& [a, b] : skeleton.edges) {
    bones += sheet.line(skeleton.nodes[a].at, skeleton.nodes[b].at);
  }
  text += "<path fill=\"none\" stroke=\"#1d3557\" stroke-width=\"3\" d=\"" + bones + "\"/>\n";
  for (const SkeletonNode& node : skeleton.nodes) {
    if (node.kind == SkeletonNodeKind::tip) continue;
    const std::string at = sheet.point(node.at);
    const std::size_t blank = at.find(' ');
    text += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>\n", at.substr(0, blank),
                        at.substr(blank + 1), node.kind == SkeletonNodeKind::part ? 4 : 2.5,
                        node.kind == SkeletonNodeKind::part ? "#e63946" : "#1d3557");
  }
  return text + "</svg>\n";
}

void write_skeleton_svg(const std::filesystem::path& path, std::span<const Polygon> shape, const Skeleton& skeleton,
                        const PictureSettings& settings) {
  write_file(path, skeleton_svg(shape, skeleton, settings));
}

void write_skeleton_geojson(const std::filesystem::path& path, const Skeleton& skeleton) {
  constexpr std::array names{"part", "cut", "tip"};
  std::string text = "{\"type\":\"FeatureCollection\",\"features\":[";
  for (std::size_t n = 0; n < skeleton.nodes.size(); ++n) {
    const SkeletonNode& node = skeleton.nodes[n];
    fmt::format_to(std::back_inserter(text),
                   "{}\n{{\"type\":\"Feature\",\"properties\":{{\"node\":{},\"kind\":\"{}\"}},\"geometry\":{{\"type\":"
                   "\"Point\",\"coordinates\":[{},{}]}}}}",
                   n > 0 ? "," : "", n, names[static_cast<std::size_t>(node.kind)], node.at.x(), node.at.y());
  }
  for (const auto& [a, b] : skeleton.edges) {
    const Eigen::Vector2d &p = skeleton.nodes[a].at, &q = skeleton.nodes[b].at;
    fmt::format_to(std::back_inserter(text),
                   ",\n{{\"type\":\"Feature\",\"properties\":{{\"from\":{},\"to\":{}}},\"geometry\":{{\"type\":"
                   "\"LineString\",\"coordinates\":[[{},{}],[{},{}]]}}}}",
                   a, b, p.x(), p.y(), q.x(), q.y());
  }
  write_file(path, text + "\n]}\n");
}

}  // namespace partwise
