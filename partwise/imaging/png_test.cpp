#include "partwise/imaging/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

class Png : public testing::Test {
 protected:
  TestFolder test_folder_;
  const std::filesystem::path& folder_ = test_folder_.path();
};

TEST_F(Png, RoundTripIsExactInTheFilesCodes) {
  for (int channels = 1; channels <= 4; ++channels) {
    Image image(17, 19, channels);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
      const float code = static_cast<float>((i * 37) % 256) / 255;
      const bool alpha = channels % 2 == 0 && static_cast<int>(i) % channels == channels - 1;
      image.values[i] = alpha ? code : linear_from_srgb(code);
    }
    write_png(folder_ / "a.png", image);
    const Image back = read_png(folder_ / "a.png");
    ASSERT_EQ(back.width, 17);
    ASSERT_EQ(back.height, 19);
    ASSERT_EQ(back.channels, channels);
    for (std::size_t i = 0; i < image.values.size(); ++i) EXPECT_NEAR(back.values[i], image.values[i], 1e-6f);
    EXPECT_EQ(encode_png(back), encode_png(image));
  }
}

TEST_F(Png, PlainCodesHaveNoCurveAndKeepTheirBits) {
  Image image(256, 3, 3);
  for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = static_cast<float>((i * 97) % 65536) / 65535;
  write_png(folder_ / "a.png", image, PngCodes::plain16);
  EXPECT_EQ(read_plain_png(folder_ / "a.png").values, image.values);
  write_png(folder_ / "a.png", Image(2, 2, 1, 0.4f), PngCodes::plain8);
  EXPECT_EQ(read_plain_png(folder_ / "a.png").values[3], 102.0f / 255);
}

TEST_F(Png, ClampsWhatTheFormatCannotHold) {
  Image image(2, 1, 1);
  image.values = {-1, 9};
  write_png(folder_ / "a.png", image);
  EXPECT_THAT(read_png(folder_ / "a.png").values, testing::ElementsAre(0, 1));
}

TEST_F(Png, SaysWhatIsWrongWithAFile) {
  EXPECT_THROW(read_png(folder_ / "missing.png"), InputError);
  write_file(folder_ / "text.png", "no picture at all");
  EXPECT_THROW(read_png(folder_ / "text.png"), InputError);
  const std::string whole = encode_png(Image(64, 64, 3, 0.3f));
  for (const std::size_t size : {std::size_t{0}, std::size_t{20}, whole.size() / 2, whole.size() - 15}) {
    write_file(folder_ / "short.png", whole.substr(0, size));
    EXPECT_THROW(read_png(folder_ / "short.png"), InputError) << size;
  }
  EXPECT_THROW(write_png(folder_ / "no" / "folder.png", Image(1, 1, 1)), InputError);
}

}  // namespace
}  // namespace partwise
