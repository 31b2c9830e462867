#pragma once

#include <array>
#include <cmath>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "RecordedPairs.h"

namespace omnimapper::bench {

/// Start poses around the true pose, and whether matching from each of them succeeded.
struct Basin {
  struct Start {
    TPose2D offset;
    bool right;
  };
  std::string name;
  std::vector<Start> starts;

  /// Share of right matches among the starts with low <= distance < high and flat <= |turn| < steep.
  double share(double low, double high, double flat, double steep) const {
    int count = 0, good = 0;
    for (const auto& s : starts) {
      const double distance = std::hypot(s.offset.x, s.offset.y), turned = std::abs(s.offset.phi);
      if (distance < low || distance >= high || turned < flat - 1e-6 || turned >= steep - 1e-6) continue;
      ++count;
      good += s.right;
    }
    return count > 0 ? static_cast<double>(good) / count : 0;
  }
};

constexpr double kTurnStep = 10 * kDegree, kMoveStep = 0.25;
constexpr int kTurnSteps = 3, kMoveSteps = 4;
constexpr std::array<std::pair<double, double>, 3> kRings{{{0, 0.3}, {0.3, 0.7}, {0.7, 1.5}}};
constexpr std::array<std::pair<double, double>, 2> kTurns{{{0, 15 * kDegree}, {15 * kDegree, 35 * kDegree}}};

/// A grid of start offsets: -1 to 1 m along x and y, -30 to 30 deg of turn.
inline std::vector<TPose2D> basinStarts() {
  std::vector<TPose2D> starts;
  for (int k = -kTurnSteps; k <= kTurnSteps; ++k) {
    for (int j = -kMoveSteps; j <= kMoveSteps; ++j) {
      for (int i = -kMoveSteps; i <= kMoveSteps; ++i) starts.emplace_back(i * kMoveStep, j * kMoveStep, k * kTurnStep);
    }
  }
  return starts;
}

/// Draws one row of squares for each method, with a square for each turn. A square shows the share of right matches
/// over the offset along x and y.
inline void plotBasins(std::ostream& out, const std::vector<Basin>& basins) {
  constexpr int cell = 12, side = (2 * kMoveSteps + 1) * cell, gap = 14, left = 190, top = 40;
  const int width = left + (2 * kTurnSteps + 1) * (side + gap),
            height = top + static_cast<int>(basins.size()) * (side + gap);
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height
      << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  const auto text = [&](double x, double y, const std::string& words, const char* anchor) {
    out << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\">" << words << "</text>\n";
  };
  text(10, 16,
       "Share of right matches (light: all, dark: none); in each square the start is -1 to 1 m off along x and y",
       "start");
  for (int k = -kTurnSteps; k <= kTurnSteps; ++k) {
    text(left + (k + kTurnSteps) * (side + gap) + side / 2.0, top - 6, std::to_string(k * 10) + " deg", "middle");
  }
  for (std::size_t b = 0; b < basins.size(); ++b) {
    const int y0 = top + static_cast<int>(b) * (side + gap);
    text(left - 10, y0 + side / 2.0, basins[b].name, "end");
    std::array<std::array<std::pair<int, int>, (2 * kMoveSteps + 1) * (2 * kMoveSteps + 1)>, 2 * kTurnSteps + 1>
        counts{};
    for (const auto& s : basins[b].starts) {
      const auto column = static_cast<std::size_t>(std::lround(s.offset.x / kMoveStep) + kMoveSteps),
                 row = static_cast<std::size_t>(kMoveSteps - std::lround(s.offset.y / kMoveStep)),
                 square = static_cast<std::size_t>(std::lround(s.offset.phi / kTurnStep) + kTurnSteps);
      auto& [good, count] = counts[square][row * (2 * kMoveSteps + 1) + column];
      good += s.right;
      ++count;
    }
    for (std::size_t square = 0; square < counts.size(); ++square) {
      for (std::size_t i = 0; i < counts[square].size(); ++i) {
        const auto [good, count] = counts[square][i];
        const int shade = count > 0 ? 255 * good / count : 0;
        out << "<rect x=\""
            << left + static_cast<int>(square) * (side + gap) + static_cast<int>(i % (2 * kMoveSteps + 1)) * cell
            << "\" y=\"" << y0 + static_cast<int>(i / (2 * kMoveSteps + 1)) * cell << "\" width=\"" << cell
            << "\" height=\"" << cell << "\" fill=\"rgb(" << shade << "," << (30 + shade * 220 / 255) << ","
            << (90 + shade * 60 / 255) << ")\"/>\n";
      }
    }
  }
  out << "</svg>\n";
}

}  // namespace omnimapper::bench
