#include "Chart.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/draw/Markup.h>
#include <omnimapper/draw/Svg.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "Html.h"

namespace omnimapper::plugins {

namespace {

// Sizes of the drawing in its own units; the page scales it.
constexpr double kWidth = 640, kHeight = 250, kLeft = 56, kRight = 12, kTop = 10, kBottom = 36;
constexpr std::size_t kMostColumns = 560;

struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
  bool empty() const { return !(low <= high); }
};

/// Converts values to coordinates of the drawing.
class Axes {
 public:
  explicit Axes(const Chart& chart) : logarithmic_(chart.logarithmic) {
    for (const ChartSeries& series : chart.series) {
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        if (!drawable(series.x[i], series.y[i])) continue;
        x_.add(series.x[i]);
        y_.add(scaled(series.y[i]));
      }
    }
    if (x_.empty()) return;
    if (x_.low == x_.high) x_.low -= 0.5, x_.high += 0.5;
    if (!logarithmic_) y_.add(0);
    const double room = y_.low == y_.high ? 0.5 : 0.04 * (y_.high - y_.low);
    y_.high += room;
    if (logarithmic_ || y_.low < 0) y_.low -= room;
  }

  bool empty() const { return x_.empty(); }
  bool drawable(double x, double y) const { return std::isfinite(x) && std::isfinite(y) && (!logarithmic_ || y > 0); }
  double scaled(double y) const { return logarithmic_ ? std::log10(y) : y; }
  double px(double x) const { return kLeft + (x - x_.low) / (x_.high - x_.low) * (kWidth - kLeft - kRight); }
  double py(double y) const { return kTop + (y_.high - scaled(y)) / (y_.high - y_.low) * (kHeight - kTop - kBottom); }
  std::vector<double> xTicks() const { return draw::roundValues(x_.low, x_.high, 7); }
  std::vector<double> yTicks() const {
    if (!logarithmic_) return draw::roundValues(y_.low, y_.high, 5);
    // Ticks at powers of ten; for few decades also at 2 and 5 times these, and for less than one decade at plain round
    // numbers.
    if (y_.high - y_.low < 0.7) return draw::roundValues(std::pow(10, y_.low), std::pow(10, y_.high), 4);
    const double step = std::max(1.0, std::ceil((y_.high - y_.low) / 6));
    const bool few = y_.high - y_.low < 2.5;
    std::vector<double> ticks;
    for (double power = std::floor(y_.low); power <= y_.high; power += step) {
      for (const double factor : {1, 2, 5}) {
        const double tick = factor * std::pow(10, power);
        if ((factor == 1 || few) && std::log10(tick) >= y_.low && std::log10(tick) <= y_.high) ticks.push_back(tick);
      }
    }
    return ticks;
  }

 private:
  bool logarithmic_;
  Span x_, y_;
};

std::string text(double x, double y, const std::string& anchor, const std::string& content) {
  return "<text x=\"" + base::fixed(x, 1) + "\" y=\"" + base::fixed(y, 1) + "\" text-anchor=\"" + anchor + "\">" +
         draw::escapeMarkup(content) + "</text>";
}

std::string rule(double x1, double y1, double x2, double y2) {
  return "<line class=\"grid\" x1=\"" + base::fixed(x1, 1) + "\" y1=\"" + base::fixed(y1, 1) + "\" x2=\"" +
         base::fixed(x2, 1) + "\" y2=\"" + base::fixed(y2, 1) + "\"/>";
}

std::string drawAxes(const Chart& chart, const Axes& axes) {
  const double bottom = kHeight - kBottom, right = kWidth - kRight;
  std::string svg;
  for (const double tick : axes.yTicks()) {
    svg +=
        rule(kLeft, axes.py(tick), right, axes.py(tick)) + text(kLeft - 6, axes.py(tick) + 4, "end", base::brief(tick));
  }
  for (const double tick : axes.xTicks()) {
    svg += rule(axes.px(tick), bottom, axes.px(tick), bottom + 4) +
           text(axes.px(tick), bottom + 16, "middle", base::brief(tick, 6));
  }
  svg += "<line class=\"axis\" x1=\"" + base::fixed(kLeft, 1) + "\" y1=\"" + base::fixed(bottom, 1) + "\" x2=\"" +
         base::fixed(right, 1) + "\" y2=\"" + base::fixed(bottom, 1) + "\"/>";
  return svg + text(0.5 * (kLeft + right), kHeight - 4, "middle", chart.x_label);
}

/// Indices of the points to draw. If many points share a column of the drawing, only its lowest and highest are kept.
std::vector<std::size_t> visible(const ChartSeries& series, const Axes& axes) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (axes.drawable(series.x[i], series.y[i])) all.push_back(i);
  }
  if (all.size() <= 2 * kMostColumns) return all;
  std::vector<std::size_t> kept;
  for (std::size_t column = 0; column < kMostColumns; ++column) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(column * all.size() / kMostColumns);
    const auto end = all.begin() + static_cast<std::ptrdiff_t>((column + 1) * all.size() / kMostColumns);
    auto [low, high] = std::minmax_element(begin, end, [&](auto a, auto b) { return series.y[a] < series.y[b]; });
    kept.push_back(std::min(*low, *high));
    if (low != high) kept.push_back(std::max(*low, *high));
  }
  return kept;
}

std::string drawSeries(const ChartSeries& series, const Axes& axes) {
  const std::string colour = std::to_string(series.colour);
  std::string svg;
  for (const std::size_t i : visible(series, axes)) {
    const std::string x = base::fixed(axes.px(series.x[i]), 1), y = base::fixed(axes.py(series.y[i]), 1);
    // A dot is a line of zero length with round ends, so that one path can draw all of them.
    if (series.form == ChartSeries::Form::dots) {
      svg += "M" + x + " " + y + "h0";
    } else {
      svg += (svg.empty() ? "M" : "L") + x + " " + y;
    }
  }
  if (svg.empty()) return svg;
  const std::string form = series.form == ChartSeries::Form::dots ? "dots" : "curve";
  return "<path class=\"" + form + " s" + colour + "\" d=\"" + svg + "\"/>";
}

}  // namespace

std::string drawChart(const Chart& chart) {
  const Axes axes(chart);
  if (axes.empty()) return {};
  std::string curves, legend;
  for (const ChartSeries& series : chart.series) {
    const std::string curve = drawSeries(series, axes);
    if (curve.empty()) continue;
    curves += curve;
    legend += "<span class=\"key\"><i class=\"s" + std::to_string(series.colour) + "\"></i>" +
              draw::escapeMarkup(series.name) + "</span>";
  }
  const std::string unit = chart.y_label.empty() ? "" : " <small>" + draw::escapeMarkup(chart.y_label) + "</small>";
  return "<figure class=\"card chart\"><figcaption><b>" + draw::escapeMarkup(chart.title) + "</b>" + unit +
         "<span class=\"legend\">" + legend + "</span></figcaption><svg viewBox=\"0 0 " + base::brief(kWidth) + " " +
         base::brief(kHeight) + "\" role=\"img\" aria-label=\"" + draw::escapeMarkup(chart.title) + "\">" +
         drawAxes(chart, axes) + curves + "</svg></figure>\n";
}

std::string drawBars(const std::string& title, std::vector<Bar> bars) {
  if (bars.empty()) return {};
  std::stable_sort(bars.begin(), bars.end(), [](const Bar& a, const Bar& b) { return a.value > b.value; });
  const double longest = std::max(bars.front().value, std::numeric_limits<double>::min());
  std::string html = "<figure class=\"card chart\"><figcaption><b>" + draw::escapeMarkup(title) +
                     "</b></figcaption><div class=\"bars\">";
  for (const Bar& bar : bars) {
    html += "<span>" + draw::escapeMarkup(bar.name) + "</span><span class=\"track\"><i style=\"width:" +
            base::fixed(100 * std::max(0.0, bar.value) / longest, 2) + "%\"></i></span><span class=\"num\">" +
            draw::escapeMarkup(bar.text) + "</span>";
  }
  return html + "</div></figure>\n";
}

}  // namespace omnimapper::plugins
