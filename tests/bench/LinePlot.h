#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::bench {

struct Curve {
  std::string name, colour;
  std::vector<std::pair<double, double>> points;
};

/// An SVG of curves over one axis, both axes from zero, with legend.
inline void plotCurves(std::ostream& out, const std::string& title, const std::string& x_name,
                       const std::string& y_name, const std::vector<Curve>& curves) {
  constexpr double width = 740, height = 340, left = 64, right = 220, top = 34, bottom = 46;
  double x_max = 1e-9, y_max = 1e-9;
  for (const Curve& curve : curves) {
    for (const auto& [x, y] : curve.points) x_max = std::max(x_max, x), y_max = std::max(y_max, 1.08 * y);
  }
  // Ticks at 1, 2 or 5 times a power of ten, about five of them.
  const auto tick = [](double most) {
    const double power = std::pow(10.0, std::floor(std::log10(most / 5))), part = most / 5 / power;
    return power * (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10);
  };
  const double x_tick = tick(x_max), y_tick = tick(y_max);
  x_max = x_tick * std::ceil(x_max / x_tick - 1e-9), y_max = y_tick * std::ceil(y_max / y_tick - 1e-9);
  const auto px = [&](double x) { return left + x / x_max * (width - left - right); };
  const auto py = [&](double y) { return height - bottom - y / y_max * (height - top - bottom); };
  const auto number = [](double value, const char* format = "%.1f") {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return std::string(text);
  };
  const auto text = [&](double x, double y, const std::string& words, const char* anchor) {
    out << "<text x=\"" << number(x) << "\" y=\"" << number(y) << "\" text-anchor=\"" << anchor << "\">" << words
        << "</text>\n";
  };
  const auto line = [&](double x1, double y1, double x2, double y2, const char* colour) {
    out << "<line x1=\"" << number(x1) << "\" y1=\"" << number(y1) << "\" x2=\"" << number(x2) << "\" y2=\""
        << number(y2) << "\" stroke=\"" << colour << "\"/>\n";
  };
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height
      << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  text(left, 18, title, "start");
  for (double x = 0; x <= x_max + 1e-9; x += x_tick) {
    line(px(x), py(0), px(x), py(y_max), "#e4e4e4");
    text(px(x), height - bottom + 16, number(x, "%.4g"), "middle");
  }
  for (double y = 0; y <= y_max + 1e-9; y += y_tick) {
    line(px(0), py(y), px(x_max), py(y), "#e4e4e4");
    text(left - 6, py(y) + 4, number(y, "%.3g"), "end");
  }
  text(0.5 * (left + width - right), height - 10, x_name, "middle");
  out << "<text transform=\"translate(14 " << number(0.5 * (top + height - bottom))
      << ") rotate(-90)\" text-anchor=\"middle\">" << y_name << "</text>\n";
  double row = top + 12;
  for (const Curve& curve : curves) {
    out << "<polyline fill=\"none\" stroke-width=\"2\" stroke=\"" << curve.colour << "\" points=\"";
    for (const auto& [x, y] : curve.points) out << number(px(x)) << "," << number(py(y)) << " ";
    out << "\"/>\n";
    for (const auto& [x, y] : curve.points)
      out << "<circle r=\"3\" fill=\"" << curve.colour << "\" cx=\"" << number(px(x)) << "\" cy=\"" << number(py(y))
          << "\"/>\n";
    out << "<rect x=\"" << width - right + 12 << "\" y=\"" << row - 9 << "\" width=\"14\" height=\"4\" fill=\""
        << curve.colour << "\"/>\n";
    text(width - right + 32, row - 3, curve.name, "start");
    row += 16;
  }
  out << "</svg>\n";
}

}  // namespace omnimapper::bench
