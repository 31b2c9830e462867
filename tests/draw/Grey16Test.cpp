#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/testing/Fixtures.h>

#include <fstream>

namespace omnimapper::draw::grey16_test {
namespace {

TEST(Grey16Image, mrptReadsEveryValueBack) {
  constexpr int kWidth = 37, kHeight = 23;
  std::vector<std::uint16_t> values(kWidth * kHeight);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::uint16_t>(i * 7919 * 31);
  values[3] = 65535, values[4] = 0, values[5] = 256, values[6] = 255;
  const omnimapper::testing::ScratchFolder folder;
  std::ofstream(folder / "a.png", std::ios::binary) << encodePng(Grey16Image{kWidth, kHeight, values});
  mrpt::img::CImage image;
  ASSERT_TRUE(image.loadFromFile(folder / "a.png"));
  ASSERT_EQ(image.getWidth(), static_cast<std::size_t>(kWidth));
  ASSERT_EQ(image.getHeight(), static_cast<std::size_t>(kHeight));
  ASSERT_EQ(image.getPixelDepth(), mrpt::img::PixelDepth::D16U);
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column)
      ASSERT_EQ(image.ptrLine<std::uint16_t>(row)[column], values[row * kWidth + column]) << row << " " << column;
  }
}

TEST(Grey16Image, pixelsMustFillThePicture) {
  EXPECT_THROW(encodePng(Grey16Image{2, 2, {1, 2, 3}}), base::Error);
  EXPECT_THROW(encodePng(Grey16Image{}), base::Error);
}

}  // namespace
}  // namespace omnimapper::draw::grey16_test
