#include <omnimapper/base/Numbers.h>
#include <omnimapper/draw/Svg.h>

#include <algorithm>

#include "CalibrationReport.h"

namespace omnimapper::calibration {

namespace {

constexpr int kColumns = 16, kRows = 12;
constexpr double kLonger = 20;  // factor by which residuals are drawn longer

Eigen::Vector2d medianOf(std::vector<double> across, std::vector<double> down) {
  const auto middle = [](std::vector<double>& all) {
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
    return all[all.size() / 2];
  };
  return {middle(across), middle(down)};
}

// Draws in each part of the picture the median residual of its corners, as a line from the part's middle.
void drawPanel(draw::Svg& svg, const Eigen::Vector2d& corner, const Eigen::Vector2d& size, const DepthCamera& camera,
               const HeldBack& held, const std::string& name) {
  svg.box(corner, size, "#f4f4f4");
  svg.text(corner + Eigen::Vector2d(0, -8), name + ": " + base::fixed(held.pixel_median, 2) + " px in the median",
           draw::Svg::Anchor::start, 14);
  std::vector<std::vector<double>> across(kColumns * kRows), down(kColumns * kRows);
  for (std::size_t i = 0; i < held.pixels.size(); ++i) {
    const int column = std::clamp(static_cast<int>(held.pixels[i].x() * kColumns / camera.width), 0, kColumns - 1);
    const int row = std::clamp(static_cast<int>(held.pixels[i].y() * kRows / camera.height), 0, kRows - 1);
    across[static_cast<std::size_t>(row * kColumns + column)].push_back(held.misses[i].x());
    down[static_cast<std::size_t>(row * kColumns + column)].push_back(held.misses[i].y());
  }
  constexpr std::size_t kFewest = 3;
  constexpr double kRed = 3;  // [px]
  const double zoom = size.x() / camera.width;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const auto at = static_cast<std::size_t>(row * kColumns + column);
      const Eigen::Vector2d middle =
          corner + Eigen::Vector2d((column + 0.5) * size.x() / kColumns, (row + 0.5) * size.y() / kRows);
      if (across[at].size() < kFewest) continue;
      const Eigen::Vector2d miss = medianOf(across[at], down[at]);
      const auto colour = draw::heatColour(std::min(1.0, miss.norm() / kRed));
      svg.line(middle, middle + kLonger * zoom * miss, colour, 2);
      svg.dot(middle, 2, colour);
    }
  }
}

}  // namespace

void drawResiduals(const Calibration& calibration, std::ostream& out) {
  const auto& camera = calibration.log;
  const double width = 560, height = width * camera.height / camera.width, rim = 20, top = 64;
  draw::Svg svg(out, 2 * width + 3 * rim, height + top + rim);
  svg.text({rim, 24},
           "corners of held-back views minus their predicted positions; medians, drawn 20 times as long as in the "
           "picture, red from 3 px",
           draw::Svg::Anchor::start, 14);
  drawPanel(svg, {rim, top}, {width, height}, camera, calibration.before, "before");
  drawPanel(svg, {2 * rim + width, top}, {width, height}, camera, calibration.after, "after");
}

}  // namespace omnimapper::calibration
