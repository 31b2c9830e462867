#include <gtest/gtest.h>
#include <omnimapper/eval/Plot.h>

#include <sstream>

#include "Trajectories.h"

namespace omnimapper::eval::plot_test {
namespace {

int countOf(const std::string& text, const std::string& word) {
  int count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

// The text is one drawing with every element closed and all numbers finite.
void expectDrawing(const std::string& svg) {
  EXPECT_EQ(svg.find("<svg xmlns=\"http://www.w3.org/2000/svg\""), 0u);
  EXPECT_EQ(svg.rfind("</svg>\n"), svg.size() - 7);
  EXPECT_EQ(countOf(svg, "<"), countOf(svg, "/>") + 2 * countOf(svg, "</"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

std::string plotOf(const Trajectory& estimate, const Trajectory& reference, const std::string& title = "walk") {
  std::ostringstream out;
  plotTrajectory(out, absoluteTrajectoryError(estimate, reference), reference, title);
  return out.str();
}

TEST(Plot, OfATrajectoryShowsReferenceEstimateAxesAndLegend) {
  const Trajectory reference = randomWalk(100, 1);
  const std::string svg = plotOf(withNoise(reference, 0.2, 2), reference);
  expectDrawing(svg);
  for (const char* word : {">walk<", ">x [m]<", ">y [m]<", ">error [m]<", ">reference<", ">estimate (dot: start)<"}) {
    EXPECT_EQ(countOf(svg, word), 1) << word;
  }
  EXPECT_EQ(countOf(svg, "<polyline"), 1);
  EXPECT_GT(countOf(svg, "<line"), 99);
}

TEST(Plot, HasOneScaleForBothAxes) {
  // A square of 10 m: its four corners must be a square in pixels. The reference's line holds them in order.
  const Trajectory square = {planar(0, 0, 0), planar(1, 10, 0), planar(2, 10, 10), planar(3, 0, 10)};
  const std::string svg = plotOf(square, square);
  const auto start = svg.find("points=\"") + 8;
  std::istringstream numbers(svg.substr(start, svg.find('"', start) - start));
  std::vector<Eigen::Vector2d> corners(4);
  char comma;
  for (auto& corner : corners) numbers >> corner.x() >> comma >> corner.y();
  EXPECT_NEAR((corners[1] - corners[0]).norm(), (corners[2] - corners[1]).norm(), 0.2);
  EXPECT_GT(corners[1].x(), corners[0].x());  // x to the right
  EXPECT_LT(corners[2].y(), corners[1].y());  // y up
}

TEST(Plot, OfAStandingRobotAndOfOnePoseIsStillADrawing) {
  expectDrawing(plotOf({planar(0, 1, 1)}, {planar(0, 1, 1)}));
  expectDrawing(plotOf({planar(0, 1, 1), planar(1, 1, 1)}, {planar(0, 1, 1), planar(1, 1, 1)}));
}

TEST(Plot, TitlesAreTextNotMarkup) {
  const Trajectory walk = randomWalk(5, 1);
  const std::string svg = plotOf(walk, walk, "a<b & c>d");
  expectDrawing(svg);
  EXPECT_NE(svg.find("a&lt;b &amp; c&gt;d"), std::string::npos);
}

TEST(Plot, OfErrorsShowsBothCurvesWithTheirMeans) {
  std::ostringstream out;
  // Means: 0.2 m; 0.1 rad = 5.73 deg.
  plotErrors(out, {at(0), at(1), at(2)}, {0.1, 0.2, 0.3}, {0.05, 0.1, 0.15}, "errors");
  expectDrawing(out.str());
  EXPECT_EQ(countOf(out.str(), "<polyline"), 2);
  EXPECT_NE(out.str().find("mean 0.2 m"), std::string::npos);
  EXPECT_NE(out.str().find("mean 5.73 deg"), std::string::npos);
}

TEST(Plot, OfNoErrorsIsAnEmptyDrawing) {
  std::ostringstream out;
  plotErrors(out, {}, {}, {}, "errors");
  expectDrawing(out.str());
}

}  // namespace
}  // namespace omnimapper::eval::plot_test
