#include <gtest/gtest.h>

#include "Drawn.h"
#include "LineSplitting.h"

namespace omnimapper::signs {
namespace {

// Draws upright strokes of four pixels, one every eight pixels, in a part of a picture.
void addStrokes(cv::Mat& picture, const cv::Rect& where) {
  for (int x = where.x; x < where.x + where.width; x += 8)
    picture(cv::Rect(x, where.y, 4, where.height)) = cv::Scalar::all(220);
}

TEST(LineSplitting, twoLinesArePartedInTheRowBetweenThem) {
  cv::Mat picture(120, 240, CV_8UC3, cv::Scalar::all(40));
  addStrokes(picture, {40, 20, 160, 30});
  addStrokes(picture, {80, 60, 80, 20});
  const auto parts = partsOf(picture, rectangle(30, 15, 210, 85));
  ASSERT_EQ(parts.size(), 2u);
  const float between = parts[0][2].y();
  EXPECT_EQ(parts[1][0].y(), between);
  EXPECT_GT(between, 49);
  EXPECT_LT(between, 61);
  EXPECT_EQ(parts[0][0].y(), 15);
  EXPECT_EQ(parts[1][3].y(), 85);
  // The part is narrowed to its strokes and a margin of a fifth of its height.
  EXPECT_NEAR(parts[0][0].x(), 40 - 0.2 * 35, 3);
  EXPECT_NEAR(parts[1][0].x(), 80 - 0.2 * 30, 3);
  EXPECT_NEAR(parts[1][1].x(), 156 + 0.2 * 30, 3);
}

TEST(LineSplitting, oneLineAndDotsAboveItAreNotParted) {
  cv::Mat picture(120, 240, CV_8UC3, cv::Scalar::all(40));
  addStrokes(picture, {40, 40, 160, 30});
  EXPECT_TRUE(partsOf(picture, rectangle(30, 25, 210, 75)).empty());
  picture(cv::Rect(60, 30, 4, 5)) = picture(cv::Rect(68, 30, 4, 5)) = cv::Scalar::all(220);
  EXPECT_TRUE(partsOf(picture, rectangle(30, 28, 210, 72)).empty());
}

TEST(LineSplitting, whatIsTooSmallOrBesideThePictureIsNotParted) {
  cv::Mat picture(120, 240, CV_8UC3, cv::Scalar::all(40));
  addStrokes(picture, {40, 20, 160, 4});
  addStrokes(picture, {40, 26, 160, 4});
  EXPECT_TRUE(partsOf(picture, rectangle(30, 19, 210, 30)).empty());
  EXPECT_TRUE(partsOf(picture, rectangle(30, 300, 210, 400)).empty());
  EXPECT_TRUE(partsOf(picture, rectangle(30, 30, 30, 90)).empty());
}

}  // namespace
}  // namespace omnimapper::signs
