#include "partwise/imaging/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <stdexcept>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"

namespace partwise {
namespace {

constexpr int no_threads = 0;  // of OpenEXR's own: the caller's threads are enough

class ByteReader : public Imf::IStream {
 public:
  explicit ByteReader(std::string_view bytes) : Imf::IStream("file"), bytes_(bytes) {}
  bool read(char* target, int count) override {
    if (count < 0 || at_ > bytes_.size() || static_cast<std::size_t>(count) > bytes_.size() - at_) {
      throw std::runtime_error("the file ends early");
    }
    std::copy_n(bytes_.data() + at_, count, target);
    at_ += static_cast<std::size_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  std::string_view bytes_;
  std::uint64_t at_ = 0;
};

class ByteWriter : public Imf::OStream {
 public:
  ByteWriter() : Imf::OStream("file") {}
  void write(const char* source, int count) override {
    const auto size = static_cast<std::size_t>(count);
    bytes.resize(std::max(bytes.size(), at_ + size));
    std::copy_n(source, size, bytes.data() + at_);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }

  std::string bytes;

 private:
  std::size_t at_ = 0;
};

// Names and messages come from the file: one line, whatever it holds.
std::string printable(std::string text) {
  constexpr std::size_t longest = 120;
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' ' || c >= 127; }, '?');
  return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

const std::vector<std::string>& usual_names(int channels) {
  static const std::array<std::vector<std::string>, 4> names{
      {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}}};
  return names[static_cast<std::size_t>(channels - 1)];
}

std::vector<std::string> names_to_read(const std::string& file, const Imf::ChannelList& present) {
  const auto has = [&](const char* name) { return present.findChannel(name) != nullptr; };
  if (has("R") && has("G") && has("B")) return usual_names(has("A") ? 4 : 3);
  if (has("RY") && has("BY")) throw InputError(file, "holds luminance and chroma", "save it as RGB");
  if (has("Y")) return usual_names(has("A") ? 2 : 1);
  std::string all;
  std::size_t count = 0;
  for (auto channel = present.begin(); channel != present.end(); ++channel, ++count) {
    all += (count == 0 ? "" : ", ") + std::string(channel.name());
  }
  if (count == 1) return {all};
  throw InputError(file, fmt::format("has the channels {}, no colour among them", printable(all)),
                   "give a file with R, G and B, with Y, or with one channel");
}

void check_channels(const std::string& file, const Imf::ChannelList& present, std::span<const std::string> names) {
  for (const std::string& name : names) {
    const Imf::Channel* channel = present.findChannel(name);
    if (channel == nullptr) {
      throw InputError(file, fmt::format("has no channel {}", printable(name)), "name a channel that it has");
    }
    if (channel->xSampling != 1 || channel->ySampling != 1) {
      throw InputError(file, fmt::format("has fewer samples than pixels in channel {}", printable(name)),
                       "save it as RGB");
    }
  }
}

// A header may announce any size, whatever follows. A block of 64 equal pixels may be one number (DWA), and what was
// deflated grows 1032-fold at most. The library allocates before it reads, so there is an upper limit as well.
void check_size(const std::string& file, std::int64_t width, std::int64_t height, std::size_t bytes) {
  constexpr std::int64_t most = std::int64_t{1} << 27;
  const bool sane = width >= 1 && height >= 1 && width < most && height < most && width * height <= most;
  if (!sane || static_cast<std::size_t>(width * height) > 64 * 1032 * bytes) {
    throw InputError(file,
                     fmt::format("announces {} x {} pixels, more than its {} bytes can hold", width, height, bytes),
                     "give a file that an image viewer opens");
  }
}

Image read_pixels(const std::string& file, std::string_view bytes, std::span<const std::string> wanted) {
  ByteReader stream(bytes);
  Imf::InputFile input(stream, no_threads);
  const Imf::Header& header = input.header();
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  check_size(file, width, height, bytes.size());
  const std::vector<std::string> names =
      wanted.empty() ? names_to_read(file, header.channels()) : std::vector<std::string>(wanted.begin(), wanted.end());
  check_channels(file, header.channels(), names);

  Image image(static_cast<int>(width), static_cast<int>(height), static_cast<int>(names.size()));
  Imf::FrameBuffer frame;
  const std::size_t across = names.size() * sizeof(float), down = across * static_cast<std::size_t>(width);
  for (std::size_t k = 0; k < names.size(); ++k) {
    frame.insert(names[k], Imf::Slice::Make(Imf::FLOAT, image.values.data() + k, window, across, down));
  }
  input.setFrameBuffer(frame);
  input.readPixels(window.min.y, window.max.y);
  return image;
}

// Half precision ends at 65504; beyond it would be infinite.
std::vector<half> halves(const Image& image) {
  const float largest = 65504;
  std::vector<half> result(image.values.size());
  std::ranges::transform(image.values, result.begin(),
                         [largest](float value) { return half(std::clamp(value, -largest, largest)); });
  return result;
}

}  // namespace

std::string encode_exr(std::span<const ExrLayer> layers) {
  PARTWISE_CHECK(layers.size(), >, 0u);
  const int width = layers.front().image.width, height = layers.front().image.height;
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  std::vector<std::vector<half>> kept(layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto& [image, names, precision] = layers[i];
    PARTWISE_CHECK(image.width, ==, width);
    PARTWISE_CHECK(image.height, ==, height);
    PARTWISE_CHECK(names.size(), ==, static_cast<std::size_t>(image.channels));
    const bool is_half = precision == ExrPrecision::half;
    if (is_half) kept[i] = halves(image);
    const std::size_t size = is_half ? sizeof(half) : sizeof(float), across = names.size() * size;
    // The library takes pointers to what may change, for reading and writing alike.
    char* const first = is_half ? reinterpret_cast<char*>(kept[i].data())
                                : reinterpret_cast<char*>(const_cast<float*>(image.values.data()));
    for (std::size_t k = 0; k < names.size(); ++k) {
      const Imf::PixelType type = is_half ? Imf::HALF : Imf::FLOAT;
      PARTWISE_CHECK((header.channels().findChannel(names[k]) == nullptr), ==, true);
      header.channels().insert(names[k], Imf::Channel(type));
      frame.insert(names[k], Imf::Slice(type, first + k * size, across, across * static_cast<std::size_t>(width)));
    }
  }
  ByteWriter stream;
  {
    Imf::OutputFile output(stream, header, no_threads);  // writes its table of lines when it is destroyed
    output.setFrameBuffer(frame);
    output.writePixels(height);
  }
  return std::move(stream.bytes);
}

std::string encode_exr(const Image& image, ExrPrecision precision) {
  PARTWISE_CHECK(image.channels, >=, 1);
  PARTWISE_CHECK(image.channels, <=, 4);
  const ExrLayer layer{image, usual_names(image.channels), precision};
  return encode_exr(std::span(&layer, 1));
}

void write_exr(const std::filesystem::path& path, const Image& image, ExrPrecision precision) {
  write_file(path, encode_exr(image, precision));
}

void write_exr(const std::filesystem::path& path, std::span<const ExrLayer> layers) {
  write_file(path, encode_exr(layers));
}

Image read_exr(const std::filesystem::path& path) { return decode_exr(path.string(), read_bytes(path)); }

Image read_exr(const std::filesystem::path& path, std::span<const std::string> channels) {
  return decode_exr(path.string(), read_bytes(path), channels);
}

Image decode_exr(const std::string& file, std::string_view bytes, std::span<const std::string> channels) {
  PARTWISE_CHECK(channels.size(), <=, 4u);
  try {
    return read_pixels(file, bytes, channels);
  } catch (const InputError&) {
    throw;
  } catch (const CheckFailed&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(file, fmt::format("is not a whole OpenEXR file ({})", printable(error.what())),
                     "give a file that an image viewer opens");
  }
}

}  // namespace partwise
