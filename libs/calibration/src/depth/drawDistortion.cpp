#include <omnimapper/base/Numbers.h>
#include <omnimapper/draw/Svg.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "DepthReport.h"

namespace omnimapper::calibration {

namespace {

constexpr int kAcross = 32, kDown = 24;  // parts of the image that are drawn

/// Value of a part of the image [1/m]; none if it is not known.
using ValueAt = std::function<std::optional<double>(int column, int row)>;

// Zero is in the middle of the colour scale; red is `most` and dark blue -`most`.
void drawMap(draw::Svg& svg, const Eigen::Vector2d& corner, const Eigen::Vector2d& size, double most,
             const std::string& name, const ValueAt& value_at) {
  svg.box(corner, size, "#f4f4f4");
  svg.text(corner + Eigen::Vector2d(0, -8), name, draw::Svg::Anchor::start, 14);
  const Eigen::Vector2d part(size.x() / kAcross, size.y() / kDown);
  for (int row = 0; row < kDown; ++row) {
    for (int column = 0; column < kAcross; ++column) {
      const auto value = value_at(column, row);
      if (!value) continue;
      const double share = std::clamp(0.5 + 0.5 * *value / most, 0.0, 1.0);
      svg.box(corner + part.cwiseProduct(Eigen::Vector2d(column, row)), part, draw::heatColour(share));
    }
  }
}

// The median of the residuals in each part.
ValueAt mediansOf(const HeldFlatness& flatness) {
  std::vector<std::vector<double>> all(kAcross * kDown);
  for (const auto& miss : flatness.misses) {
    const int column = std::clamp(static_cast<int>((miss.x + 1) / 2 * kAcross), 0, kAcross - 1);
    const int row = std::clamp(static_cast<int>((miss.y + 1) / 2 * kDown), 0, kDown - 1);
    all[static_cast<std::size_t>(row * kAcross + column)].push_back(miss.inverse_depth);
  }
  return [all](int column, int row) -> std::optional<double> {
    auto values = all[static_cast<std::size_t>(row * kAcross + column)];
    if (values.empty()) return std::nullopt;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
}

ValueAt overImage(const std::function<double(double x, double y)>& value) {
  return [value](int column, int row) -> std::optional<double> {
    return value((2.0 * column + 1) / kAcross - 1, (2.0 * row + 1) / kDown - 1);
  };
}

}  // namespace

void drawDistortion(const DepthCalibration& calibration, const DepthLog& log, std::ostream& out) {
  const auto& fit = calibration.fit;
  const auto& image = log.images.front();
  const double width = 480, height = width * image.height / image.width, rim = 20, top = 70, gap = 40;
  constexpr double kMost = 0.005;  // [1/m]
  draw::Svg svg(out, 2 * width + 3 * rim, 2 * height + top + gap + rim);
  svg.text({rim, 24},
           "Errors of inverse depths over the image: dark blue -5/1000 of 1/m, green 0, red 5/1000 (20 mm at 2 m), "
           "grey: no data.",
           draw::Svg::Anchor::start, 14);
  const Eigen::Vector2d size(width, height), right(width + rim, 0), down(0, height + gap), first(rim, top);
  const auto rms = [](const HeldFlatness& held) { return ": " + base::fixed(1000 * held.rms, 2) + "/1000 rms"; };
  drawMap(svg, first, size, kMost,
          "held-back planes, median distance from the fitted planes, before" + rms(calibration.before),
          mediansOf(calibration.before));
  drawMap(svg, first + right, size, kMost, "the same, after" + rms(calibration.after), mediansOf(calibration.after));
  drawMap(svg, first + down, size, kMost, "the distortion, which is added to inverse depths",
          overImage([&](double x, double y) { return fit.distortion.at(x, y); }));
  drawMap(svg, first + right + down, size, kMost, "its standard deviation, 5 times enlarged",
          overImage([&](double x, double y) { return 5 * fit.sigmaAt(x, y); }));
}

}  // namespace omnimapper::calibration
