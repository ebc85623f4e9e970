// Labels of faces in Princeton's .seg form.
#include <fmt/format.h>

#include <iterator>
#include <limits>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/geometry/mesh_formats.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/geometry/text_scanner.h"

namespace partwise {

std::vector<int> read_labels(const std::filesystem::path& path) {
  const std::string bytes = read_bytes(path);
  TextScanner scanner(path.string(), bytes);
  std::vector<int> labels;
  while (!scanner.at_end()) {
    const std::int64_t label = scanner.integer("the label of a face");
    if (label < std::numeric_limits<int>::min() || label > std::numeric_limits<int>::max()) {
      scanner.fail(fmt::format("label {} is too large", label), "use labels of 32 bits");
    }
    if (!scanner.at_line_end()) scanner.fail("a line holds more than one label", "write one label a line");
    labels.push_back(static_cast<int>(label));
  }
  if (labels.empty()) throw InputError(path.string(), "holds no labels", "give one label a line, a line a face");
  return labels;
}

void write_labels(const std::filesystem::path& path, std::span<const int> labels) {
  std::string text;
  for (const int label : labels) fmt::format_to(std::back_inserter(text), "{}\n", label);
  write_file(path, text);
}

}  // namespace partwise
