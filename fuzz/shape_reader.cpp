// What libFuzzer calls: one reader of shapes in the plane, chosen by PARTWISE_FUZZ_FORMAT, and the repair behind it.
// Whatever the bytes, the outcome is a valid shape or an InputError of one line.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "fuzz/outcome.h"
#include "partwise/geometry/polygon_formats.h"
#include "partwise/geometry/polygon_io.h"
#include "partwise/geometry/polygon_validity.h"
#include "partwise/imaging/png.h"
#include "partwise/parts/planar/read_shape.h"

namespace {

using namespace partwise;
using namespace partwise::fuzz;

constexpr std::string_view format = PARTWISE_FUZZ_FORMAT;

PolygonFile read(const std::string& bytes, bool repair, bool lenient) {
  if (format == "png") return mask_shape(decode_png("fuzz", bytes), repair, "fuzz");
  const auto polygons = [&] {
    if (format == "poly") return read_poly("fuzz", bytes, lenient);
    if (format == "wkt") return read_wkt("fuzz", bytes);
    if (format == "geojson") return read_geojson("fuzz", bytes);
    return read_svg("fuzz", bytes, 0);
  };
  return valid_polygons(polygons(), repair, "fuzz");
}

void expect_shape_or_message(const std::string& bytes, bool repair, bool lenient) {
  expect_message_or([&] {
    const PolygonFile file = read(bytes, repair, lenient);
    if (file.polygons.empty()) give_up("a shape without polygons");
    if (find_fault(file.polygons)) give_up("a shape that is not valid");
    if (!repair && !file.repaired.empty()) give_up("a shape that was repaired though this was not wanted");
  });
}

// Masks are small here: what takes time is tracing many pixels, not reading them.
bool is_large_png(std::string_view bytes) {
  if (format != "png" || bytes.size() < 24) return false;
  const auto number = [&](std::size_t at) {
    std::uint64_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
  };
  return number(16) * number(20) > 128 * 128;
}

}  // namespace

// GEOS 3.11 forgets rings when an overlay fails half way (PolygonBuilder); what is ours it hands out to owners.
extern "C" const char* __lsan_default_suppressions() { return "leak:libgeos"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  if (is_large_png(bytes)) return 0;
  expect_shape_or_message(bytes, true, false);
  expect_shape_or_message(bytes, false, true);
  return 0;
}
