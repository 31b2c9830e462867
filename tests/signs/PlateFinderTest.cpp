#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "PlateFinder.h"

namespace omnimapper::signs {
namespace {

using Eigen::Vector2f;

Corners box(float left, float top, float right, float bottom) {
  return {Vector2f(left, top), Vector2f(right, top), Vector2f(right, bottom), Vector2f(left, bottom)};
}

void fill(cv::Mat& picture, const Corners& quad, const cv::Scalar& colour) {
  std::vector<cv::Point> corners;
  for (const auto& corner : quad) corners.emplace_back(cvRound(corner.x()), cvRound(corner.y()));
  cv::fillConvexPoly(picture, corners, colour);
}

// Letters of four bars, with the margin around them that a detector leaves.
void write(cv::Mat& picture, const Corners& text) {
  constexpr float kMargin = 5;
  for (float x = text[0].x() + kMargin; x + 4 < text[1].x() - kMargin; x += 8)
    fill(picture, box(x, text[0].y() + kMargin, x + 3, text[3].y() - kMargin), {230, 230, 230});
}

// A wall with a plate on it, and text.
cv::Mat wallWith(const Corners& plate, const std::vector<Corners>& texts) {
  cv::Mat picture(480, 640, CV_8UC3, cv::Scalar(150, 170, 180));
  fill(picture, plate, {90, 60, 60});
  for (const auto& text : texts) write(picture, text);
  return picture;
}

void expectNear(const Corners& found, const Corners& expected, float most) {
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LT((found[i] - expected[i]).norm(), most) << i << ": " << found[i].transpose();
}

TEST(PlateFinder, findsThePlateAboutItsTexts) {
  const Corners plate = box(200, 100, 380, 220), number = box(230, 120, 300, 145), name = box(230, 170, 340, 185);
  const auto plates = findPlates(wallWith(plate, {number, name}), {number, name});
  ASSERT_EQ(plates.size(), 1u);
  EXPECT_EQ(plates[0].lines, (std::vector<std::size_t>{0, 1}));
  EXPECT_GT(plates[0].score, 0.95);
  expectNear(plates[0].quad, plate, 3);
}

TEST(PlateFinder, findsAPlateThatIsSeenAslant) {
  const Corners plate = {Vector2f(200, 100), {380, 115}, {380, 215}, {200, 225}}, text = box(230, 135, 330, 160);
  const auto plates = findPlates(wallWith(plate, {text}), {text});
  ASSERT_EQ(plates.size(), 1u);
  expectNear(plates[0].quad, plate, 6);
}

TEST(PlateFinder, aTextOnABareWallHasItsOwnSurroundings) {
  const Corners text = box(230, 135, 330, 155);
  cv::Mat picture(480, 640, CV_8UC3, cv::Scalar(150, 170, 180));
  const auto plates = findPlates(picture, {text});
  ASSERT_EQ(plates.size(), 1u);
  EXPECT_EQ(plates[0].score, 0);
  expectNear(plates[0].quad, box(210, 121, 350, 169), 1);
}

TEST(PlateFinder, everyLineIsOnOnePlate) {
  const Corners left = box(100, 100, 220, 180), right = box(380, 100, 500, 180);
  const std::vector<Corners> texts{box(120, 125, 200, 145), box(400, 125, 480, 145), box(100, 380, 180, 400)};
  cv::Mat picture = wallWith(left, {});
  fill(picture, right, {200, 90, 60});
  for (const auto& text : texts) write(picture, text);
  const auto plates = findPlates(picture, texts);
  ASSERT_EQ(plates.size(), 3u);
  std::vector<int> counts(3);
  for (const auto& plate : plates)
    for (const auto line : plate.lines) ++counts[line];
  EXPECT_EQ(counts, (std::vector<int>{1, 1, 1}));
}

TEST(PlateFinder, textsAtTheRimOfAPictureAndBeyondDoNoHarm) {
  const cv::Mat picture(40, 60, CV_8UC3, cv::Scalar(150, 170, 180)), pixel(1, 1, CV_8UC3, cv::Scalar(0, 0, 0));
  for (const auto& text : {box(-5, -5, 20, 8), box(50, 30, 70, 45), box(500, 500, 520, 510), box(3, 3, 3, 3)}) {
    EXPECT_EQ(findPlates(picture, {text}).size(), 1u);
    EXPECT_EQ(findPlates(pixel, {text}).size(), 1u);
  }
  EXPECT_TRUE(findPlates(picture, {}).empty());
}

}  // namespace
}  // namespace omnimapper::signs
