#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <omnimapper/draw/Drawing.h>
#include <omnimapper/draw/Svg.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>
#include <fstream>

namespace omnimapper::draw::drawing_test {
namespace {

using omnimapper::testing::ScratchFolder;

TEST(Drawing, aLineCoversItsWidthAndNothingElse) {
  Image image(20, 20, {255, 255, 255});
  drawLine(image, {4, 10}, {16, 10}, {{0, 0, 0}, 4});
  for (int y = 0; y < 20; ++y) EXPECT_EQ(image.at(10, y).r, y >= 8 && y < 12 ? 0 : 255) << y;
  EXPECT_EQ(image.at(0, 10).r, 255);
  drawLine(image, {-50, -50}, {80, 90}, {{0, 0, 0}, 3});  // cut off at the border
}

TEST(Drawing, aPathIsInkedOnceWhereItCrossesItself) {
  Image image(20, 20, {200, 200, 200});
  drawPath(image, {{2, 10}, {18, 10}, {10, 10}, {10, 2}, {10, 18}}, {{0, 0, 0}, 4, 0.5});
  EXPECT_EQ(image.at(10, 10).r, 100);
  EXPECT_EQ(image.at(5, 10).r, 100);
}

TEST(Png, mrptReadsBackEveryPixel) {
  ScratchFolder folder;
  Image image(3, 2, {1, 2, 3});
  image.at(2, 1) = {250, 128, 7};
  std::ofstream(folder / "a.png", std::ios::binary) << encodePng(image);
  mrpt::img::CImage read;
  ASSERT_TRUE(read.loadFromFile(folder / "a.png"));
  ASSERT_EQ(read.getWidth(), 3u);
  ASSERT_EQ(read.getHeight(), 2u);
  EXPECT_EQ(read.at<std::uint8_t>(0, 0, 2), 1);
  EXPECT_EQ(read.at<std::uint8_t>(0, 0, 0), 3);
  EXPECT_EQ(read.at<std::uint8_t>(2, 1, 2), 250);
  EXPECT_EQ(read.at<std::uint8_t>(2, 1, 1), 128);
}

TEST(FillAreas, EvenOddToTheMiddleOfPixels) {
  Image image(6, 5, {0, 0, 0});
  fillAreas(image, {{{1, 1}, {5, 1}, {5, 4}, {1, 4}}, {{2.4, 2}, {3.6, 2}, {3.6, 3}, {2.4, 3}}},
            {{200, 100, 50}, 0, 0.5});
  int filled = 0;
  for (const Rgb& pixel : image.pixels) filled += pixel.r == 100 && pixel.g == 50 && pixel.b == 25;
  EXPECT_EQ(filled, 4 * 3 - 2);
  EXPECT_EQ(image.at(2, 2).r, 0);
  EXPECT_EQ(image.at(3, 2).r, 0);
  EXPECT_EQ(image.at(1, 2).r, 100);
  fillAreas(image, {{}, {{-100, -100}, {100, -100}, {100, 100}}},
            {{255, 255, 255}, 0, 1});  // what is outside is cut off
  EXPECT_EQ(image.at(5, 0).r, 255);
}

TEST(RoundValues, coverTheRange) {
  EXPECT_EQ(roundValues(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(roundValues(-0.3, 0.3, 3), (std::vector<double>{-0.2, 0, 0.2}));
  EXPECT_EQ(roundValues(7, 7, 5), std::vector<double>{7});
  EXPECT_EQ(roundValues(7, std::nextafter(7, 8), 5), std::vector<double>{7}) << "they differ by rounding alone";
}

}  // namespace
}  // namespace omnimapper::draw::drawing_test
