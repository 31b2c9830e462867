#include <omnimapper/base/Numbers.h>
#include <omnimapper/draw/Svg.h>
#include <omnimapper/eval/Plot.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace omnimapper::eval {

namespace {

constexpr const char* kReferenceColour = "#9a9a9a";
constexpr const char* kTranslationColour = "#2a5caa";
constexpr const char* kRotationColour = "#c2571a";

Eigen::Vector2d seenFromAbove(const geometry::Se3& pose) {
  return pose.translation.head<2>();
}

std::string withUnit(double value, const char* unit) {
  char text[48];
  std::snprintf(text, sizeof text, "%.4g %s", value, unit);
  return text;
}

draw::Axes axesAround(const std::vector<PosePair>& pairs, const Trajectory& reference) {
  Eigen::Vector2d low = seenFromAbove(pairs.front().estimate), high = low;
  const auto include = [&](const Eigen::Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  };
  for (const auto& pair : pairs) include(seenFromAbove(pair.estimate));
  for (const auto& pose : reference) include(seenFromAbove(pose.world_from_body));
  return draw::Axes::withEqualScale({70, 70}, {700, 600}, low, high);
}

void drawColourBar(draw::Svg& svg, double max_error) {
  const draw::Axes bar({815, 110}, {18, 480}, {0, 0}, {1, max_error});
  constexpr int kSteps = 60;
  for (int i = 0; i < kSteps; ++i) {
    svg.box({815, 110 + 480.0 * i / kSteps}, {18, 480.0 / kSteps + 0.5}, draw::heatColour(1 - (i + 0.5) / kSteps));
  }
  for (const double value : draw::roundValues(0, bar.high().y(), 6)) {
    svg.text({839, bar.pixel({0, value}).y() + 4}, base::brief(value, 6), draw::Svg::Anchor::start);
  }
  svg.text({824, 98}, "error [m]", draw::Svg::Anchor::middle);
}

void drawCurve(draw::Svg& svg, const draw::Axes& axes, const std::vector<base::Stamp>& stamps,
               const std::vector<double>& errors, double unit, const char* unit_name, const char* colour) {
  std::vector<Eigen::Vector2d> points;
  double sum = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    points.push_back(axes.pixel({base::secondsBetween(stamps.front(), stamps[i]), errors[i] * unit}));
    sum += errors[i] * unit;
  }
  const double mean = sum / static_cast<double>(errors.size());
  svg.line(axes.pixel({axes.low().x(), mean}), axes.pixel({axes.high().x(), mean}), "#bbbbbb", 1.5);
  svg.polyline(points, colour, 1.5);
  const Eigen::Vector2d corner = axes.pixel(axes.high());
  svg.text({corner.x(), corner.y() - 9}, "mean " + withUnit(mean, unit_name), draw::Svg::Anchor::end);
}

}  // namespace

void plotTrajectory(std::ostream& out, const AbsoluteTrajectoryError& error, const Trajectory& reference,
                    const std::string& title) {
  const auto& pairs = error.paired.pairs;
  const double max_error = error.translation.max > 0 ? error.translation.max : 1;
  draw::Svg svg(out, 900, 730);
  const draw::Axes axes = axesAround(pairs, reference);
  axes.draw(svg, "x [m]", "y [m]");
  std::vector<Eigen::Vector2d> reference_line;
  for (const auto& pose : reference) reference_line.push_back(axes.pixel(seenFromAbove(pose.world_from_body)));
  svg.polyline(reference_line, kReferenceColour, 4);
  Eigen::Vector2d last = axes.pixel(seenFromAbove(pairs.front().estimate));
  svg.dot(last, 4, draw::heatColour(error.translation_errors.front() / max_error));
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const Eigen::Vector2d here = axes.pixel(seenFromAbove(pairs[i].estimate));
    if ((here - last).norm() < 0.5 && i + 1 < pairs.size()) continue;
    svg.line(last, here, draw::heatColour(error.translation_errors[i] / max_error), 1.8);
    last = here;
  }
  drawColourBar(svg, max_error);
  svg.text({70, 32}, title, draw::Svg::Anchor::start, 16);
  svg.line({500, 50}, {530, 50}, kReferenceColour, 4);
  svg.text({537, 54}, "reference", draw::Svg::Anchor::start);
  svg.line({620, 50}, {650, 50}, draw::heatColour(0.25), 1.8);
  svg.text({657, 54}, "estimate (dot: start)", draw::Svg::Anchor::start);
}

void plotErrors(std::ostream& out, const std::vector<base::Stamp>& stamps,
                const std::vector<double>& translation_errors, const std::vector<double>& rotation_errors,
                const std::string& title) {
  constexpr double kDegrees = 180 / geometry::kPi;
  draw::Svg svg(out, 900, 560);
  svg.text({70, 32}, title, draw::Svg::Anchor::start, 16);
  if (stamps.empty()) return;
  const double seconds = base::secondsBetween(stamps.front(), stamps.back());
  const auto highest = [](const std::vector<double>& errors) {
    return *std::max_element(errors.begin(), errors.end());
  };
  const draw::Axes upper({70, 75}, {790, 180}, {0, 0}, {seconds, 1.05 * highest(translation_errors)});
  const draw::Axes lower({70, 325}, {790, 180}, {0, 0}, {seconds, 1.05 * kDegrees * highest(rotation_errors)});
  upper.draw(svg, "", "[m]");
  lower.draw(svg, "time [s]", "[deg]");
  drawCurve(svg, upper, stamps, translation_errors, 1, "m", kTranslationColour);
  drawCurve(svg, lower, stamps, rotation_errors, kDegrees, "deg", kRotationColour);
}

}  // namespace omnimapper::eval
