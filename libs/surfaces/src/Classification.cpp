#include "omnimapper/surfaces/Classification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>

#include "SurfaceContext.h"

namespace omnimapper::surfaces {

namespace {

constexpr std::size_t kNeighbours = 5;
constexpr double kAlike = 4;  // largest distance of a similar example

/// Facts scaled so that two views of one surface differ by about 1 in each.
using Scaled = std::array<double, 16>;

Scaled scaled(const SurfaceFacts& facts) {
  const auto length = [](double metres, double least, double factor) {
    return std::log(std::clamp(metres, least, 6.0)) / factor;
  };
  const auto height = [](double metres) { return std::clamp(metres, -1.0, 3.5); };
  const auto flag = [](bool is) { return is ? 1 / 0.6 : 0; };
  return {height(facts.bottom) / 0.12,
          height(facts.top) / 0.15,
          length(facts.longer, 0.05, 0.25),
          length(facts.shorter, 0.05, 0.25),
          facts.filled / 0.3,
          length(facts.top_longer, 0.2, 0.5),
          length(facts.top_shorter, 0.2, 0.5),
          length(facts.before_wall, 0.1, 0.5),
          length(facts.plane_width, 0.1, 0.5),
          flag(facts.is_at_seat),
          flag(facts.is_at_bed),
          flag(facts.has_outer_corner),
          flag(facts.has_inner_corner),
          flag(facts.has_front),
          flag(facts.is_below_level),
          flag(facts.is_on_level)};
}

double squaredDistance(const Scaled& a, const Scaled& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

using Votes = std::vector<std::pair<double, SurfaceClass>>;  // shares of all votes, most first

std::string textOf(const SurfaceFacts& facts, const Votes& votes) {
  char text[160];
  if (facts.lie == Lie::upright) {
    std::snprintf(text, sizeof text, "upright from %.2f to %.2f m above the floor, %.2f m wide%s%s%s", facts.bottom,
                  facts.top, facts.longer, facts.before_wall > 0 ? ", close in front of a wall" : "",
                  facts.is_at_bed    ? ", beside a bed"
                  : facts.is_at_seat ? ", beside a seat"
                                     : "",
                  facts.has_outer_corner ? ", a side of a box" : "");
  } else {
    std::snprintf(text, sizeof text, "%s, %.2f m above the floor, %.2f by %.2f m",
                  facts.lie == Lie::up     ? "level"
                  : facts.lie == Lie::down ? "facing down"
                                           : "tilted",
                  (facts.bottom + facts.top) / 2, facts.longer, facts.shorter);
  }
  std::string reason = text;
  if (votes.empty()) reason += ": similar to no known example";
  for (std::size_t i = 0; i < votes.size() && i < 2 && votes[i].first >= 0.01; ++i) {
    std::snprintf(text, sizeof text, "%s%s %.2f", i == 0 ? ": " : ", ", toString(votes[i].second).c_str(),
                  votes[i].first);
    reason += text;
  }
  return reason;
}

/// Examples prepared for the comparison with surfaces.
class Voters {
 public:
  explicit Voters(const std::vector<Example>& examples) {
    for (const auto& example : examples) by_lie_[example.facts.lie].emplace_back(scaled(example.facts), example.is);
  }

  Votes votesOn(const SurfaceFacts& facts) const {
    const auto there = by_lie_.find(facts.lie);
    if (there == by_lie_.end()) return {};
    const Scaled place = scaled(facts);
    std::vector<std::pair<double, SurfaceClass>> nearest;
    for (const auto& [example, is] : there->second) nearest.emplace_back(squaredDistance(place, example), is);
    const auto kept = std::min(kNeighbours, nearest.size());
    std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(kept), nearest.end());
    std::map<SurfaceClass, double> weights;
    double whole = 0;
    for (std::size_t i = 0; i < kept && nearest[i].first <= kAlike * kAlike; ++i) {
      constexpr double kSame = 0.01;
      const double weight = 1 / (kSame + nearest[i].first);
      weights[nearest[i].second] += weight;
      whole += weight;
    }
    Votes votes;
    for (const auto& [is, weight] : weights) votes.emplace_back(weight / whole, is);
    std::stable_sort(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    return votes;
  }

 private:
  std::map<Lie, std::vector<std::pair<Scaled, SurfaceClass>>> by_lie_;
};

}  // namespace

std::vector<Judgement> classify(const std::vector<Surface>& surfaces, double floor,
                                const std::vector<Example>& examples) {
  constexpr double kHalf = 0.5;
  static const Voters of_known(knownExamples());
  std::optional<Voters> of_others;
  if (&examples != &knownExamples()) of_others.emplace(examples);
  const Voters& voters = of_others ? *of_others : of_known;
  std::vector<Judgement> judgements;
  const auto all = factsOf(surfaces, floor);
  for (const auto& facts : all) {
    Judgement& judgement = judgements.emplace_back();
    if (facts.plan.empty()) continue;
    const Votes votes = voters.votesOn(facts);
    judgement.reason = textOf(facts, votes);
    if (!votes.empty() && votes.front().first >= kHalf) judgement.is = votes.front().second;
  }
  judgeInContext(surfaces, all, judgements);
  return judgements;
}

}  // namespace omnimapper::surfaces
