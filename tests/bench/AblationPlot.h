#pragma once

#include <omnimapper/draw/Svg.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "AblationRuns.h"

namespace omnimapper::bench {

/// A dot plot with a row for each variant and a panel for each log. The absolute trajectory error is on a logarithmic x
/// axis.
class AblationPlot {
 public:
  AblationPlot(std::vector<AblationVariant> variants, std::vector<AblationRun> runs)
      : variants_(std::move(variants)), runs_(std::move(runs)) {
    for (const auto& run : runs_) {
      if (std::find(logs_.begin(), logs_.end(), run.log) == logs_.end()) logs_.push_back(run.log);
    }
    placeRows();
    chooseRange();
  }

  /// Replaces the file. Without runs it writes nothing.
  void write(const std::string& path) const {
    if (runs_.empty()) return;
    std::ofstream out(path);
    draw::Svg svg(out, std::max(kLeastWidth, panelLeft(logs_.size()) - kGap + kMargin), bottom() + 116);
    drawTitle(svg);
    drawRowNames(svg);
    for (std::size_t i = 0; i < logs_.size(); ++i) drawPanel(svg, i);
    drawLegend(svg);
  }

 private:
  static constexpr double kMargin = 20, kNames = 240, kTop = 108, kRow = 22, kGap = 18, kLeastWidth = 780;
  static constexpr double kInset = 12;  // from a panel's left and right edges to its lowest and highest value

  // Rows of one family are grouped below the name of the family.
  void placeRows() {
    double y = kTop;
    for (std::size_t i = 0; i < variants_.size(); ++i) {
      if (i == 0 || variants_[i].family != variants_[i - 1].family) y += i == 0 ? kRow : 1.5 * kRow;
      rows_.push_back(y + 0.5 * kRow);
      y += kRow;
    }
  }

  // The axis begins at the last tick that is not above the least error and ends at the first that is not below the
  // largest one.
  void chooseRange() {
    double least = INFINITY, most = 0;
    for (const auto& run : runs_) {
      if (!run.isMapped()) continue;
      least = std::min(least, run.ate), most = std::max(most, run.ate);
    }
    if (!(most > 0)) least = 0.01, most = 1;
    low_ = 1e-6, high_ = 1e6;
    for (const double value : ticks(1e-6, 1e6)) {
      if (value <= least) low_ = value;
      if (value >= most && high_ == 1e6) high_ = value;
    }
  }

  // Axis ticks: 1, 2 and 5 times powers of ten.
  static std::vector<double> ticks(double low, double high) {
    std::vector<double> values;
    for (int power = -6; power <= 6; ++power) {
      for (const double mantissa : {1.0, 2.0, 5.0}) {
        const double value = mantissa * std::pow(10, power);
        if (value >= 0.999 * low && value <= 1.001 * high) values.push_back(value);
      }
    }
    return values;
  }

  double panelWidth() const { return std::clamp(800 / static_cast<double>(logs_.size()) - kGap, 140.0, 330.0); }
  double panelLeft(std::size_t panel) const {
    return kMargin + kNames + static_cast<double>(panel) * (panelWidth() + kGap);
  }
  double bottom() const { return rows_.back() + 0.7 * kRow; }
  draw::Axes axes(std::size_t panel) const {
    return {{panelLeft(panel) + kInset, kTop},
            {panelWidth() - 2 * kInset, bottom() - kTop},
            {std::log10(low_), 0},
            {std::log10(high_), 1}};
  }
  double pixelX(std::size_t panel, double error) const {
    return axes(panel).pixel({std::log10(std::clamp(error, low_, high_)), 0}).x();
  }

  const AblationRun* find(const std::string& log, const AblationVariant& variant) const {
    for (const auto& run : runs_) {
      if (run.log == log && run.variant == variant.key) return &run;
    }
    return nullptr;
  }

  std::string travelOf(const std::string& log) const {
    for (const auto& run : runs_) {
      if (run.log == log && std::isfinite(run.travel)) return base::fixed(run.travel, 1) + " m travelled";
    }
    return "";
  }

  static std::string colourOf(const AblationVariant& variant) {
    return variant.family == AblationVariant::Family::visual ? "#2471a3" : "#c2571a";
  }

  void drawTitle(draw::Svg& svg) const {
    svg.text({kMargin, 28}, "A depth camera in the hand: error of its trajectory by the source and method of odometry",
             draw::Svg::Anchor::start, 16);
    svg.text(
        {kMargin, 48},
        "One row for each variant, one panel for each log. Farther to the left is better; the scale is logarithmic.",
        draw::Svg::Anchor::start, 12);
  }

  void drawRowNames(draw::Svg& svg) const {
    for (std::size_t i = 0; i < variants_.size(); ++i) {
      if (i == 0 || variants_[i].family != variants_[i - 1].family) {
        const bool visual = variants_[i].family == AblationVariant::Family::visual;
        svg.text({kMargin, rows_[i] - kRow + 4}, visual ? "visual odometry" : "clouds, by GICP unless stated",
                 draw::Svg::Anchor::start, 13);
      }
      svg.text({kMargin + kNames - 10, rows_[i] + 4}, variants_[i].title, draw::Svg::Anchor::end);
    }
  }

  void drawPanel(draw::Svg& svg, std::size_t panel) const {
    const double left = panelLeft(panel), right = left + panelWidth();
    svg.box({left, kTop}, {panelWidth(), bottom() - kTop}, "#f6f6f6");
    svg.text({0.5 * (left + right), kTop - 24}, logs_[panel], draw::Svg::Anchor::middle, 13);
    svg.text({0.5 * (left + right), kTop - 9}, travelOf(logs_[panel]), draw::Svg::Anchor::middle, 11);
    drawScale(svg, panel);
    for (const double y : rows_) svg.line({left, y}, {right, y}, "#e0e0e0", 1);
    // A vertical line marks the error of the first variant, with which the others are compared.
    const AblationRun* first = find(logs_[panel], variants_.front());
    if (first && first->isMapped()) {
      const double x = pixelX(panel, first->ate);
      svg.line({x, kTop}, {x, bottom()}, "#8fb3cf", 1.5);
    }
    for (std::size_t i = 0; i < variants_.size(); ++i) {
      if (const auto* run = find(logs_[panel], variants_[i]))
        drawRun(svg, panel, rows_[i], *run, colourOf(variants_[i]));
    }
  }

  void drawScale(draw::Svg& svg, std::size_t panel) const {
    double free_from = -INFINITY;  // a number that would overlap the one before it is left out
    for (const double value : ticks(low_, high_)) {
      const double x = pixelX(panel, value);
      const bool is_power = std::abs(std::log10(value) - std::round(std::log10(value))) < 1e-6;
      svg.line({x, kTop}, {x, bottom()}, is_power ? "#c8c8c8" : "#ffffff", 1);
      if (!is_power && panelWidth() < 200) continue;
      if (x < free_from) continue;
      svg.text({x, bottom() + 16}, base::brief(value), draw::Svg::Anchor::middle);
      free_from = x + 32;
    }
    svg.text({panelLeft(panel) + 0.5 * panelWidth(), bottom() + 35}, "ATE [m]", draw::Svg::Anchor::middle);
  }

  static void drawMark(draw::Svg& svg, const Eigen::Vector2d& at, bool hollow, const std::string& colour) {
    svg.dot(at, 5, colour);
    if (hollow) svg.dot(at, 3.2, "#ffffff");
  }

  static void drawCross(draw::Svg& svg, const Eigen::Vector2d& at) {
    svg.line(at + Eigen::Vector2d(-4, -4), at + Eigen::Vector2d(4, 4), "#333333", 1.5);
    svg.line(at + Eigen::Vector2d(-4, 4), at + Eigen::Vector2d(4, -4), "#333333", 1.5);
  }

  void drawRun(draw::Svg& svg, std::size_t panel, double y, const AblationRun& run, const std::string& colour) const {
    const double left = panelLeft(panel), right = left + panelWidth();
    if (!run.isMapped()) {
      drawCross(svg, {right - kInset, y});
      return;
    }
    const double x = pixelX(panel, run.ate);
    drawMark(svg, {x, y}, run.isSuspicious(), colour);
    const bool to_the_right = x < right - 48;
    svg.text({x + (to_the_right ? 9 : -9), y + 4}, base::fixed(run.ate, run.ate < 0.0995 ? 3 : 2),
             to_the_right ? draw::Svg::Anchor::start : draw::Svg::Anchor::end, 11);
  }

  void drawLegend(draw::Svg& svg) const {
    const double y = bottom() + 62, text = y + 4;
    const double x = kMargin;
    drawMark(svg, {x + 6, y}, false, "#555555");
    svg.text({x + 18, text}, "verdict consistent or \"cannot tell\"", draw::Svg::Anchor::start);
    drawMark(svg, {x + 256, y}, true, "#555555");
    svg.text({x + 268, text}, "verdict suspicious", draw::Svg::Anchor::start);
    drawCross(svg, {x + 411, y});
    svg.text({x + 423, text}, "no map", draw::Svg::Anchor::start);
    svg.line({x + 501, y - 8}, {x + 501, y + 8}, "#8fb3cf", 1.5);
    svg.text({x + 511, text}, "error of the first row", draw::Svg::Anchor::start);
    const std::vector<std::string> notes{
        "ATE: absolute trajectory error, root mean square of the distances to the true positions after the best rigid "
        "alignment",
        "Verdict: how the mapper judges its own map, without knowing the truth. With planes: planes are landmarks "
        "in addition to the odometry."};
    for (std::size_t i = 0; i < notes.size(); ++i)
      svg.text({x, text + 22 + 16 * static_cast<double>(i)}, notes[i], draw::Svg::Anchor::start, 11);
  }

  std::vector<AblationVariant> variants_;
  std::vector<AblationRun> runs_;
  std::vector<std::string> logs_;
  std::vector<double> rows_;      // middles [px]
  double low_ = 0.01, high_ = 1;  // [m]
};

}  // namespace omnimapper::bench
