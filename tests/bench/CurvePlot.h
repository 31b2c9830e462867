#pragma once

#include <omnimapper/draw/Svg.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::bench {

/// One curve of a plot.
struct PlottedCurve {
  std::string name, colour;
  std::vector<std::pair<double, double>> points;  ///< (x, y)
};

/// Writes an SVG with curves on common axes that begin at 0, and a legend.
inline void plotCurves(const std::string& path, const std::string& title, const std::string& x_name,
                       const std::string& y_name, const std::vector<PlottedCurve>& curves) {
  Eigen::Vector2d high(1e-9, 1e-9);
  for (const PlottedCurve& curve : curves) {
    for (const auto& [x, y] : curve.points) high = high.cwiseMax(Eigen::Vector2d(x, y));
  }
  std::ofstream out(path);
  draw::Svg svg(out, 760, 370);
  svg.text({110, 18}, title, draw::Svg::Anchor::start, 14);
  const draw::Axes axes({110, 47}, {380, 270}, {0, 0}, 1.05 * high);
  axes.draw(svg, x_name, y_name);
  double y = 62;
  for (const PlottedCurve& curve : curves) {
    std::vector<Eigen::Vector2d> line;
    for (const auto& [at, value] : curve.points) line.push_back(axes.pixel({at, value}));
    svg.polyline(line, curve.colour, 1.5);
    for (const auto& point : line) svg.dot(point, 2.5, curve.colour);
    svg.line({505, y - 4}, {525, y - 4}, curve.colour, 3);
    svg.text({530, y}, curve.name, draw::Svg::Anchor::start);
    y += 18;
  }
}

}  // namespace omnimapper::bench
