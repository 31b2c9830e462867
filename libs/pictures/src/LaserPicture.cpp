#include "LaserPicture.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/draw/Drawing.h>
#include <omnimapper/draw/Legend.h>
#include <omnimapper/obs/CObservationLaserLines.h>

#include <algorithm>
#include <cmath>

#include "IndexRgb.h"

namespace omnimapper::pictures {

namespace {

constexpr int kSide = 800;  // [px] width and height of the picture
constexpr int kMostSquares = 100;
constexpr draw::Rgb kGround{255, 255, 255}, kSquares{225, 225, 225}, kPoints{130, 130, 130}, kSensor{0, 0, 0};

std::vector<Eigen::Vector2d> pointsOf(const mrpt::obs::CObservation2DRangeScan& scan) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
    const double range = static_cast<double>(scan.getScanRange(i)), angle = static_cast<double>(scan.getScanAngle(i));
    if (!scan.getScanRangeValidity(i) || !std::isfinite(range) || !std::isfinite(angle)) continue;
    if (range >= static_cast<double>(scan.maxRange)) continue;
    points.emplace_back(range * std::cos(angle), range * std::sin(angle));
  }
  return points;
}

/// The square part of the plane that the picture shows.
class View {
 public:
  explicit View(const std::vector<Eigen::Vector2d>& points) {
    Eigen::Vector2d low(-1, -1), high(1, 1);
    for (const auto& point : points) low = low.cwiseMin(point), high = high.cwiseMax(point);
    middle_ = 0.5 * (low + high);
    scale_ = 0.95 * kSide / (high - low).maxCoeff();
  }
  draw::PixelPoint operator()(const Eigen::Vector2d& point) const {
    return {0.5 * kSide + scale_ * (point.x() - middle_.x()), 0.5 * kSide - scale_ * (point.y() - middle_.y())};
  }
  Eigen::Vector2d lowest() const { return middle_.array() - 0.5 * kSide / scale_; }
  Eigen::Vector2d highest() const { return middle_.array() + 0.5 * kSide / scale_; }

 private:
  Eigen::Vector2d middle_;
  double scale_;  // [px / m]
};

// Draws squares of 1 m, or of 10, 100 and so on in a wide view, so that there are at most kMostSquares in a row.
// Returns their side [m].
double drawSquares(draw::Image& picture, const View& view) {
  const Eigen::Vector2d low = view.lowest(), high = view.highest();
  double side = 1;  // [m]
  while ((high - low).maxCoeff() / side > kMostSquares) side *= 10;
  for (int axis = 0; axis < 2; ++axis) {
    const double first = std::ceil(low[axis] / side);
    for (int i = 0; i <= kMostSquares && side * (first + i) <= high[axis]; ++i) {
      Eigen::Vector2d from = low, to = high;
      from[axis] = to[axis] = side * (first + i);
      drawLine(picture, view(from), view(to), {kSquares, 1});
    }
  }
  return side;
}

void drawLines(draw::Image& picture, const View& view, const obs::CObservationLaserLines& found,
               std::vector<draw::LegendRow>& legend) {
  if (!found.lines.empty())
    legend.push_back({indexRgb(0), std::to_string(found.lines.size()) + " lines, a colour each"});
  for (std::size_t i = 0; i < found.lines.size(); ++i) {
    const draw::Pen pen{indexRgb(i), 3};
    const auto& segment = found.lines[i].segment_in_sensor;
    const draw::PixelPoint from = view(segment.from), to = view(segment.to);
    drawLine(picture, from, to, pen);
    const double x = to.x - from.x, y = to.y - from.y, bar = 6 / std::max(1e-9, std::hypot(x, y));
    for (const draw::PixelPoint& end : {from, to})
      drawLine(picture, {end.x - bar * y, end.y + bar * x}, {end.x + bar * y, end.y - bar * x}, pen);
  }
}

}  // namespace

draw::Image drawLaserPicture(const mrpt::obs::CObservation2DRangeScan& scan,
                             const std::vector<mrpt::obs::CObservation::Ptr>& derived) {
  const auto points = pointsOf(scan);
  const View view(points);
  draw::Image picture(kSide, kSide, kGround);
  const double side = drawSquares(picture, view);
  std::vector<draw::LegendRow> legend{{kSquares, "squares of " + base::brief(side) + " m, the sensor in black"},
                                      {kPoints, "scan"}};
  for (const auto& point : points) drawDot(picture, view(point), {kPoints, 4});
  drawDot(picture, view({0, 0}), {kSensor, 9});
  for (const auto& observation : derived) {
    if (const auto* lines = dynamic_cast<const obs::CObservationLaserLines*>(observation.get()))
      drawLines(picture, view, *lines, legend);
  }
  draw::drawLegend(picture, legend);
  return picture;
}

}  // namespace omnimapper::pictures
