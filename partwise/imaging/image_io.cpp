#include "partwise/imaging/image_io.h"

#include <algorithm>
#include <cctype>

#include "partwise/base/error.h"
#include "partwise/imaging/exr.h"
#include "partwise/imaging/hdr.h"
#include "partwise/imaging/jpeg.h"
#include "partwise/imaging/netpbm.h"
#include "partwise/imaging/png.h"

namespace partwise {

Image read_image(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".exr") return read_exr(path);
  if (ending == ".hdr" || ending == ".pic") return read_hdr(path);
  if (ending == ".png") return read_png(path);
  if (ending == ".jpg" || ending == ".jpeg") return read_jpeg(path);
  if (ending == ".pgm" || ending == ".ppm") return read_netpbm(path);
  throw InputError(path.string(), "has the ending of no image format that is read",
                   "give .exr, .hdr, .pic, .png, .jpg, .pgm or .ppm");
}

}  // namespace partwise
