#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <omnimapper/base/Error.h>

#include <opencv2/core.hpp>

#include "../../signs/Drawn.h"
#include "salient_signs/Pixels.h"
#include "salient_signs/SaliencyProposer.h"

namespace omnimapper::signs::saliency_test {
namespace {

using camera::ColourImage;

// A plate of 80 x 40 pixels with a row of strokes on it.
Drawn sign(int left, int top) {
  Drawn drawn(640, 480, 180);
  drawn.fill(left, top, left + 80, top + 40, 60);
  for (int i = 0; i < 6; ++i) drawn.fill(left + 10 + 10 * i, top + 12, left + 14 + 10 * i, top + 28, 230);
  return drawn;
}

// The plate's outer edges lie half a pixel beyond the middles of its outer pixels.
TEST(SaliencyProposer, aLonePlateIsFoundToThePixel) {
  const auto regions = SaliencyProposer({}).propose(sign(300, 200).view());
  ASSERT_FALSE(regions.empty());
  const Corners expected = rectangle(299.5f, 199.5f, 379.5f, 239.5f);
  double best = 1e9;
  for (const Corners& region : regions) {
    double worst = 0;
    for (std::size_t i = 0; i < 4; ++i) worst = std::max<double>(worst, (region[i] - expected[i]).norm());
    best = std::min(best, worst);
  }
  EXPECT_LT(best, 3);  // the surroundings are searched at half the size, or less
}

TEST(SaliencyProposer, anEvenPictureHasNothingSalient) {
  EXPECT_TRUE(SaliencyProposer({}).propose(Drawn(640, 480, 120).view()).empty());
}

TEST(SaliencyProposer, regionsKeepTheLimitsOfSize) {
  SaliencyOptions options;
  options.min_width = 200;
  EXPECT_TRUE(SaliencyProposer(options).propose(sign(300, 200).view()).empty());
}

// The salient component is the text, so its box is not that of the plate.
TEST(SaliencyProposer, withoutPlatesRegionsAreUprightBoxesOfComponents) {
  SaliencyOptions options;
  options.fit_plates = false;
  const auto regions = SaliencyProposer(options).propose(sign(300, 200).view());
  ASSERT_FALSE(regions.empty());
  for (const Corners& region : regions) {
    EXPECT_EQ(region[0].y(), region[1].y());
    EXPECT_EQ(region[0].x(), region[3].x());
    EXPECT_EQ(region[2].y(), region[3].y());
  }
}

TEST(SaliencyProposer, picturesOfAnySizeAreTaken) {
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 700}, {700, 2}, {17, 31}, {333, 101}, {64, 2000}}) {
    Drawn drawn(width, height, 90);
    drawn.fill(width / 3, height / 3, width / 2, height / 2, 220);
    EXPECT_NO_THROW(SaliencyProposer({}).propose(drawn.view())) << width << " x " << height;
  }
  EXPECT_TRUE(SaliencyProposer({}).propose(ColourImage{}).empty());
}

TEST(SaliencyProposer, aPictureWithoutMemoryIsRefused) {
  EXPECT_THROW(SaliencyProposer({}).propose({nullptr, 40, 30, 40, ColourImage::Order::grey}), base::Error);
  const Drawn drawn(40, 30, 0);
  EXPECT_THROW(SaliencyProposer({}).propose({drawn.pixels.data(), 40, 30, 39, ColourImage::Order::grey}), base::Error);
  EXPECT_THROW(SaliencyProposer({}).propose({drawn.pixels.data(), -4, 30, 40, ColourImage::Order::grey}), base::Error);
}

TEST(PixelsOf, picturesOf16BitsAreRefusedAndEmptyOnesAreEmpty) {
  const mrpt::img::CImage deep(cv::Mat(30, 40, CV_16UC1, cv::Scalar(500)), mrpt::img::SHALLOW_COPY);
  try {
    pixelsOf(deep);
    FAIL() << "16 bits were taken";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
    EXPECT_NE(std::string(error.what()).find("16 bits"), std::string::npos);
  }
  EXPECT_EQ(pixelsOf(mrpt::img::CImage()).width, 0);
}

TEST(PixelsOf, pixelsAreThoseOfThePicture) {
  mrpt::img::CImage picture(8, 4, mrpt::img::CH_RGB);
  picture.setPixel(3, 2, mrpt::img::TColor(10, 20, 30));
  const ColourImage view = pixelsOf(picture);
  ASSERT_EQ(view.width, 8);
  ASSERT_EQ(view.height, 4);
  ASSERT_EQ(view.order, ColourImage::Order::bgr);
  const auto* pixel = view.pixels + 2 * view.stride + 3 * 3;
  EXPECT_EQ(pixel[0], 30);
  EXPECT_EQ(pixel[1], 20);
  EXPECT_EQ(pixel[2], 10);
}

}  // namespace
}  // namespace omnimapper::signs::saliency_test
