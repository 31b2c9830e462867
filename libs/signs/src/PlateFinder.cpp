#include "PlateFinder.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "PlateOutlines.h"

namespace omnimapper::signs {

namespace {

// Weights of the parts of a candidate's worth; its edges add at most 1.3.
constexpr double kOfSize = 0.06, kOfLine = 0.1, kOfCutLine = 0.3;

struct Candidate {
  Outline outline;
  double worth = 0;
  std::vector<std::size_t> lines;
};

// Computes the worth of a candidate around `line` from all lines of the picture. Returns false if that line is not on
// it.
bool weigh(const std::vector<Corners>& lines, std::size_t line, Candidate& candidate) {
  float tallest = 0;
  int cut = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto inside = std::count_if(lines[i].begin(), lines[i].end(),
                                      [&](const auto& corner) { return contains(candidate.outline.quad, corner); });
    if (inside == 4) {
      candidate.lines.push_back(i);
      tallest = std::max(tallest, heightOf(lines[i]));
    } else if (inside > 0) {
      ++cut;
    }
  }
  if (std::find(candidate.lines.begin(), candidate.lines.end(), line) == candidate.lines.end()) return false;
  const double size = std::log(areaOf(candidate.outline.quad) / (tallest * tallest));
  candidate.worth = candidate.outline.mean_edge + 0.3 * candidate.outline.weakest_edge + kOfSize * size +
                    kOfLine * static_cast<double>(candidate.lines.size() - 1) - kOfCutLine * cut;
  return true;
}

}  // namespace

std::vector<Plate> findPlates(const cv::Mat& picture, const std::vector<Corners>& lines) {
  std::vector<Candidate> candidates;
  for (std::size_t line = 0; line < lines.size(); ++line) {
    for (const auto& outline : outlinesAbout(picture, lines[line])) {
      Candidate candidate{outline, 0, {}};
      if (weigh(lines, line, candidate)) candidates.push_back(std::move(candidate));
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.worth > b.worth; });
  std::vector<Plate> plates;
  std::vector<bool> is_taken(lines.size(), false);
  for (auto& candidate : candidates) {
    if (std::any_of(candidate.lines.begin(), candidate.lines.end(), [&](auto line) { return is_taken[line]; }))
      continue;
    for (const auto line : candidate.lines) is_taken[line] = true;
    const float reach = 0.3f * heightOf(lines[candidate.lines.front()]);
    plates.push_back(
        {refined(picture, candidate.outline.quad, reach), candidate.outline.mean_edge, std::move(candidate.lines)});
  }
  constexpr Margins kAboutALine{1, 1, 0.7f, 0.7f};
  for (std::size_t line = 0; line < lines.size(); ++line)
    if (!is_taken[line]) plates.push_back({grown(lines[line], kAboutALine), 0, {line}});
  return plates;
}

}  // namespace omnimapper::signs
