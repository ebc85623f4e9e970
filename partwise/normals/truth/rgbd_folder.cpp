#include "partwise/normals/truth/rgbd_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"

namespace partwise {
namespace {

using Path = std::filesystem::path;
using Frames = std::vector<RgbdFiles>;

constexpr double most_seconds_apart = 0.02;

std::vector<Path> pictures_in(const Path& folder) {
  std::vector<Path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".png" || ending == ".jpg" || ending == ".pgm" || ending == ".ppm") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

// Nearest in time; of two as near, the earlier.
Frames nearest_in_time(const std::map<double, Path>& depths, const std::map<double, Path>& colours, RgbdFiles like) {
  Frames frames;
  for (const auto& [time, depth] : depths) {
    auto nearest = colours.lower_bound(time);
    if (nearest == colours.end() ||
        (nearest != colours.begin() && time - std::prev(nearest)->first <= nearest->first - time)) {
      if (nearest == colours.begin()) continue;
      --nearest;
    }
    if (std::abs(nearest->first - time) > most_seconds_apart) continue;
    like.depth = depth;
    like.colour = nearest->second;
    frames.push_back(like);
  }
  return frames;
}

std::optional<double> number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

// Lines of a time and a file; those that begin with # are comments.
std::map<double, Path> timed_files(const Path& list) {
  std::istringstream text(read_bytes(list));
  std::map<double, Path> files;
  std::string line;
  for (int i = 1; std::getline(text, line); ++i) {
    std::istringstream fields(line);
    std::string time, name;
    fields >> time;
    if (time.empty() || time.starts_with('#')) continue;
    fields >> name;
    const std::optional<double> seconds = number(time);
    if (!seconds || name.empty()) {
      throw InputError(fmt::format("{}:{}", list.string(), i), "is not a time and a file", "write both in a line");
    }
    files[*seconds] = list.parent_path() / name;
  }
  return files;
}

Frames sun_frames(const Path& folder) {
  const std::vector<Path> depths = pictures_in(folder / "depth"), colours = pictures_in(folder / "image");
  if (depths.size() != 1 || colours.size() != 1) {
    throw InputError(folder.string(),
                     fmt::format("has {} pictures in depth/ and {} in image/, a frame of SUN RGB-D one each",
                                 depths.size(), colours.size()),
                     "leave one each");
  }
  return {{RgbdFormat::sun, colours[0], depths[0], folder / "intrinsics.txt"}};
}

Frames tum_frames(const Path& folder) {
  RgbdFiles like{RgbdFormat::tum, {}, {}};
  const std::string name = std::filesystem::absolute(folder).lexically_normal().string();
  for (int camera = 1; camera <= 3; ++camera) {
    if (name.find(fmt::format("freiburg{}", camera)) != std::string::npos) like.tum_camera = camera;
  }
  return nearest_in_time(timed_files(folder / "depth.txt"), timed_files(folder / "rgb.txt"), like);
}

Frames redwood_frames(const Path& folder, const Path& colour_folder) {
  const auto frame_of = [](const Path& file) {
    const std::string stem = file.stem().string();
    return stem.substr(0, stem.find('-'));
  };
  std::map<std::string, Path> colours;
  for (const Path& colour : pictures_in(colour_folder)) colours.emplace(frame_of(colour), colour);
  Path intrinsics = folder / "intrinsics.txt";
  if (!std::filesystem::is_regular_file(intrinsics)) intrinsics.clear();
  Frames frames;
  for (const Path& depth : pictures_in(folder / "depth")) {
    const auto colour = colours.find(frame_of(depth));
    if (colour != colours.end()) frames.push_back({RgbdFormat::redwood, colour->second, depth, intrinsics});
  }
  return frames;
}

Frames nyu_frames(const std::vector<Path>& pictures) {
  std::map<double, Path> depths, colours;
  for (const Path& each : pictures) {
    const std::string name = each.filename().string();
    const bool depth = name.starts_with("d-") && name.ends_with(".pgm");
    if (!depth && !(name.starts_with("r-") && name.ends_with(".ppm"))) continue;
    if (const auto time = number(name.substr(2, name.find('-', 2) - 2))) (depth ? depths : colours)[*time] = each;
  }
  return nearest_in_time(depths, colours, {RgbdFormat::nyu, {}, {}});
}

Frames named_pairs(const std::vector<Path>& pictures) {
  constexpr std::array<std::pair<const char*, RgbdFormat>, 4> formats{
      {{"NYU", RgbdFormat::nyu}, {"Redwood", RgbdFormat::redwood}, {"SUN", RgbdFormat::sun}, {"TUM", RgbdFormat::tum}}};
  Frames frames;
  for (const auto& [name, format] : formats) {
    const auto find = [&, name = name](const char* what) {
      return std::ranges::find(pictures, fmt::format("{}_{}", name, what),
                               [](const Path& p) { return p.stem().string(); });
    };
    const auto depth = find("depth"), colour = find("color");
    if (depth != pictures.end() && colour != pictures.end()) frames.push_back({format, *colour, *depth});
  }
  return frames;
}

Frames frames_of_layout(const Path& folder) {
  const auto is_folder = [&](const char* name) { return std::filesystem::is_directory(folder / name); };
  const auto is_file = [&](const char* name) { return std::filesystem::is_regular_file(folder / name); };
  if (is_file("intrinsics.txt") && is_folder("depth") && is_folder("image")) return sun_frames(folder);
  if (is_file("depth.txt") && is_file("rgb.txt")) return tum_frames(folder);
  for (const char* colour : {"color", "image", "rgb"}) {
    if (is_folder("depth") && is_folder(colour)) return redwood_frames(folder, folder / colour);
  }
  const std::vector<Path> pictures = pictures_in(folder);
  Frames frames = nyu_frames(pictures);
  return frames.empty() ? named_pairs(pictures) : frames;
}

}  // namespace

Frames find_rgbd_frames(const Path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw InputError(folder.string(), "is no folder", "name the folder of a data set's frames");
  }
  Frames frames = frames_of_layout(folder);
  if (frames.empty()) {
    throw InputError(folder.string(), "holds no pair of colour and depth in a layout that is known",
                     "give frames of NYU Depth v2 (raw), SUN RGB-D, TUM or Redwood");
  }
  return frames;
}

}  // namespace partwise
