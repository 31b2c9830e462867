#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/OnnxBytes.h>

#include <fstream>
#include <opencv2/imgproc.hpp>

#include "TextDetector.h"

namespace omnimapper::signs {
namespace {

// A network that takes every bright pixel for text.
class TextDetectorTest : public ::testing::Test {
 protected:
  // It looks at squares of `window` pixels, so that its output is smaller than its input by `window` - 1.
  std::shared_ptr<const net::Network> network(int window = 1) const {
    using namespace testing::onnx_bytes;
    const std::vector<int> image{1, 3, 480, 736}, map{1, 1, 481 - window, 737 - window};
    const std::vector<float> ones(static_cast<std::size_t>(3 * window * window), 1);
    std::ofstream(folder_ / "bright.onnx", std::ios::binary) << model(
        {node("Conv", {"x", "w"}, "sum", {attribute("kernel_shape", {window, window})}), node("Sigmoid", {"sum"}, "y")},
        {weights("w", {1, 3, window, window}, ones)}, {value("x", image)}, {value("y", map)});
    return std::make_shared<net::Network>(folder_ / "bright.onnx", net::Backend::opencv);
  }

  testing::ScratchFolder folder_;
};

TEST_F(TextDetectorTest, linesAreTheCoresGrownByHandWorkedMargins) {
  // The picture is twice as large as the network's input.
  cv::Mat picture(960, 1472, CV_8UC3, cv::Scalar::all(0));
  picture(cv::Rect(400, 200, 202, 42)) = cv::Scalar::all(255);
  picture(cv::Rect(100, 600, 202, 42)) = cv::Scalar::all(255);
  picture(cv::Rect(900, 600, 4, 4)) = cv::Scalar::all(255);  // too small for a text
  const auto lines = TextDetector(network()).detect(picture);
  ASSERT_EQ(lines.size(), 2u);
  // The core is 100 x 20 px between the middles of its pixels; the line is larger by 1.6 times 2000 / 120.
  const float growth = 2 * 1.6f * 2000 / 120;
  const auto& first = lines[0];
  EXPECT_NEAR(widthOf(first.quad), 200 + growth, 0.5);
  EXPECT_NEAR(heightOf(first.quad), 40 + growth, 0.5);
  EXPECT_LT((middleOf(first.quad) - Eigen::Vector2f(500.5, 220.5)).norm(), 1);
  EXPECT_LT(first.quad[0].x(), first.quad[1].x());
  EXPECT_LT(first.quad[0].y(), first.quad[3].y());
  EXPECT_GT(first.score, 0.9);
  EXPECT_LT(middleOf(lines[1].quad).x(), 300);
}

TEST_F(TextDetectorTest, picturesOfAllSizesAreTaken) {
  const TextDetector detector(network());
  EXPECT_TRUE(detector.detect({}).empty());
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 3000), cv::Size(3000, 1), cv::Size(640, 480)})
    EXPECT_TRUE(detector.detect(cv::Mat(size, CV_8UC3, cv::Scalar::all(0))).empty()) << size;
}

TEST_F(TextDetectorTest, aNetworkOfAnotherShapeIsRefused) {
  try {
    const TextDetector detector(network(3));
    FAIL() << "it was taken";
  } catch (const base::Error& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("bright.onnx: is not the network that finds text"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace omnimapper::signs
