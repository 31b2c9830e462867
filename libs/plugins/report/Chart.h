#pragma once

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// One curve, or cloud of dots, of a chart.
struct ChartSeries {
  enum class Form { line, dots };
  std::string name;
  int colour = 1;  ///< 1 to 4: index of a colour in the style sheet
  Form form = Form::line;
  std::vector<double> x, y;
};

struct Chart {
  std::string title, x_label, y_label;
  bool logarithmic = false;  ///< logarithmic y axis; values <= 0 are left out
  std::vector<ChartSeries> series;
};

/// A figure with an inline SVG, axes and a legend. Long curves are thinned to the resolution of the drawing, and peaks
/// are kept. Empty if there is nothing finite to draw.
std::string drawChart(const Chart& chart);

struct Bar {
  std::string name;
  double value = 0;
  std::string text;  ///< text beside the bar
};
/// Horizontal bars, the longest first.
std::string drawBars(const std::string& title, std::vector<Bar> bars);

}  // namespace omnimapper::plugins
