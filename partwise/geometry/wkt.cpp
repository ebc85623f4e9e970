// Well-known text, read by GEOS.
#include <fmt/format.h>

#include <algorithm>

#include "partwise/geometry/geos.h"
#include "partwise/geometry/polygon_formats.h"
#include "partwise/geometry/text_scanner.h"

namespace partwise {
namespace {

void note_message(const char* message, void* text) { *static_cast<std::string*>(text) = message; }

}  // namespace

Polygons read_wkt(const std::string& file, const std::string& bytes) {
  // GEOS descends once for each nested collection; nobody nests them deeply, but a broken file may.
  if (std::count(bytes.begin(), bytes.end(), 'N') > 0) {
    int depth = 0;
    for (char c : bytes) {
      depth += c == '(' ? 1 : c == ')' ? -1 : 0;
      if (depth > 100) throw InputError(file, "nests more than 100 brackets", "give plain polygons");
    }
  }
  std::string text = bytes, message;
  if (text.starts_with("SRID=")) text.erase(0, std::min(text.find(';'), text.size() - 1) + 1);
  const Geos geos;
  GEOSContext_setErrorMessageHandler_r(geos.context(), note_message, &message);
  GEOSWKTReader* reader = GEOSWKTReader_create_r(geos.context());
  GEOSGeometry* read = GEOSWKTReader_read_r(geos.context(), reader, text.c_str());
  GEOSWKTReader_destroy_r(geos.context(), reader);
  if (read == nullptr) {
    throw InputError(file, fmt::format("is not well-known text ({})", shown_reason(message)),
                     "correct or export it again");
  }
  const auto geometry = geos.own(read);
  Polygons polygons;
  geos.collect(geometry.get(), polygons);
  return polygons;
}

}  // namespace partwise
