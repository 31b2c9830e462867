#include "ClockFit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "Quantile.h"

namespace omnimapper::check {

namespace {

constexpr double kMostError = 0.17;       // [rad] of a turn that is not simply wrong
constexpr std::size_t kFewestTurns = 20;  // turns
constexpr double kSurelyOffset = 20;  // twice the logarithm of the likelihood ratio of two offsets; see OdometryClock

// How well the headings explain the turns at one offset.
struct Cost {
  double sum = 0;  // [rad2] of the squared errors
  std::size_t turns = 0;
  double mean() const { return sum / static_cast<double>(turns); }
};

Cost costAt(const std::vector<MeasuredTurn>& turns, const Headings& headings, double offset, double sign) {
  const auto shift = base::durationFromSeconds(offset);
  Cost cost;
  for (const auto& turn : turns) {
    const double other = headings.turn(turn.begin + shift, turn.end + shift);
    if (std::isnan(other)) continue;
    const double error = std::min(kMostError, std::abs(sign * other - turn.turn));
    cost.sum += error * error;
    ++cost.turns;
  }
  return cost;
}

// Twice the logarithm of the ratio of the likelihoods, per the turns that are compared.
double advantage(const Cost& best, double other_mean) {
  constexpr double kLeast = 1e-6;  // [rad2] of errors that no sensor goes below
  return static_cast<double>(best.turns) * std::log(std::max(other_mean, kLeast) / std::max(best.mean(), kLeast));
}

struct Trial {
  double offset = 0, sign = 1;
  Cost cost;
};

constexpr double kCoarse = 0.1;  // [s]

std::vector<Trial> trials(const std::vector<MeasuredTurn>& turns, const Headings& headings) {
  std::vector<Trial> all;
  const int most = static_cast<int>(kMostOffset / kCoarse);
  for (int i = -most; i <= most; ++i) {
    const double offset = i * kCoarse;
    // Clocks that are off by minutes are rare, and outside of the headings nothing is compared.
    const auto shift = base::durationFromSeconds(offset);
    if (turns.back().end + shift < headings.begin() || turns.front().begin + shift > headings.end()) continue;
    for (const double sign : {1.0, -1.0}) {
      const auto cost = costAt(turns, headings, offset, sign);
      if (cost.turns >= kFewestTurns) all.push_back({offset, sign, cost});
    }
  }
  return all;
}

// The minimum near `start` by a parabola through three offsets, with its standard deviation.
std::optional<ClockFacts> refined(const std::vector<MeasuredTurn>& turns, const Headings& headings, double start,
                                  double sign) {
  constexpr double kFine = 0.02, kReach = 0.04;  // [s]
  Trial best{start, sign, costAt(turns, headings, start, sign)};
  for (double offset = start - 1.5 * kCoarse; offset <= start + 1.5 * kCoarse; offset += kFine) {
    const auto cost = costAt(turns, headings, offset, sign);
    if (cost.turns >= kFewestTurns && cost.mean() < best.cost.mean()) best = {offset, sign, cost};
  }
  if (best.cost.turns < kFewestTurns) return std::nullopt;
  const auto before = costAt(turns, headings, best.offset - kReach, sign);
  const auto after = costAt(turns, headings, best.offset + kReach, sign);
  if (before.turns < kFewestTurns || after.turns < kFewestTurns) return std::nullopt;
  const double a = before.mean(), b = best.cost.mean(), c = after.mean();
  const double curvature = (a - 2 * b + c) / (kReach * kReach);  // [rad2 / s2]
  if (!(curvature > 0)) return std::nullopt;
  ClockFacts fit;
  fit.offset = best.offset + kReach * 0.5 * (a - c) / (a - 2 * b + c);
  fit.sigma = std::sqrt(2 * b / (curvature * static_cast<double>(best.cost.turns)));
  fit.is_reversed = sign < 0;
  return fit;
}

// The change of the offset from the first third of the turns to the last, if it is steady. Delays of drivers come and
// go, but clocks that drift apart do so all the time.
double driftOf(std::vector<MeasuredTurn> turns, const Headings& headings, const ClockFacts& clock) {
  constexpr double kSigmas = 6, kLeast = 0.1;  // [s]
  constexpr double kSteady = 0.25;             // of the change, that the middle may be off
  std::sort(turns.begin(), turns.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  const double sign = clock.is_reversed ? -1 : 1;
  std::array<ClockFacts, 3> parts;
  std::array<base::Stamp, 3> middles;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto begin = turns.begin() + static_cast<std::ptrdiff_t>(i * turns.size() / 3);
    const auto end = turns.begin() + static_cast<std::ptrdiff_t>((i + 1) * turns.size() / 3);
    const std::vector<MeasuredTurn> some(begin, end);
    const auto part = some.empty() ? std::nullopt : refined(some, headings, clock.offset, sign);
    if (!part) return 0;
    parts[i] = *part;
    middles[i] = some[some.size() / 2].begin;
  }
  const double change = parts[2].offset - parts[0].offset;
  if (std::abs(change) < std::max(kLeast, kSigmas * std::hypot(parts[0].sigma, parts[2].sigma))) return 0;
  const double seconds = base::secondsBetween(middles[0], middles[2]);
  const double share = base::secondsBetween(middles[0], middles[1]) / seconds;
  const double off = parts[1].offset - parts[0].offset - share * change;
  return seconds > 0 && std::abs(off) < kSteady * std::abs(change) ? change / seconds : 0;
}

}  // namespace

bool ClockFacts::isWrong() const {
  constexpr double kLeast = 0.02, kSigmas = 4;  // [s]
  return std::abs(offset) > std::max(kLeast, kSigmas * sigma);
}

void Headings::add(base::Stamp stamp, double turn) {
  constexpr double kLongest = 1;  // [s]
  if (headings_.empty()) {
    first_ = last_ = stamp;
    headings_.push_back(0);
    return;
  }
  const double seconds = base::secondsBetween(last_, stamp);
  if (seconds <= 0) return;
  const double begin = base::secondsBetween(first_, last_);
  const bool is_known = seconds <= kLongest && std::isfinite(turn);
  constexpr std::size_t kMost = 5'000'000;  // steps, a day
  const double end = begin + seconds;
  if (end / kStep > static_cast<double>(kMost)) return;
  while (static_cast<double>(headings_.size()) * kStep <= end) {
    const double share = (static_cast<double>(headings_.size()) * kStep - begin) / seconds;
    headings_.push_back(is_known ? heading_ + share * turn : std::nan(""));
  }
  // A turn across a pause is not known, however far its ends are from the pause.
  heading_ = is_known ? heading_ + turn : 0;
  if (!is_known) parts_.push_back(headings_.size());
  last_ = stamp;
}

double Headings::at(double seconds) const {
  const double place = seconds / kStep;
  if (!(place >= 0) || place >= static_cast<double>(headings_.size()) - 1) return std::nan("");
  const auto before = static_cast<std::size_t>(place);
  const double share = place - static_cast<double>(before);
  return (1 - share) * headings_[before] + share * headings_[before + 1];
}

double Headings::turn(base::Stamp begin, base::Stamp end) const {
  if (headings_.empty()) return std::nan("");
  const double from = base::secondsBetween(first_, begin), to = from + base::secondsBetween(begin, end);
  const auto partOf = [this](double seconds) {
    const auto step = static_cast<std::size_t>(std::max(0.0, seconds / kStep));
    return std::upper_bound(parts_.begin(), parts_.end(), step) - parts_.begin();
  };
  return !parts_.empty() && partOf(from) != partOf(to) ? std::nan("") : at(to) - at(from);
}

Headings headingsOf(std::vector<base::Stamp> stamps, const std::function<double(base::Stamp, base::Stamp)>& turn) {
  // One wrong stamp must not make the log a year long.
  constexpr double kMargin = 3600;  // [s]
  Headings headings;
  if (stamps.empty()) return headings;
  const auto margin = base::durationFromSeconds(kMargin);
  const auto low = quantile(stamps, 0.01) - margin, high = quantile(stamps, 0.99) + margin;
  stamps.erase(std::remove_if(stamps.begin(), stamps.end(), [&](base::Stamp one) { return one < low || one > high; }),
               stamps.end());
  std::sort(stamps.begin(), stamps.end());
  for (std::size_t i = 0; i < stamps.size(); ++i) headings.add(stamps[i], i > 0 ? turn(stamps[i - 1], stamps[i]) : 0);
  return headings;
}

// Noise favours some offset, but not by much. Of the offsets about 300 s away there are thousands to choose from, so
// that one of them must be better by more.
std::optional<ClockFacts> fitClock(const std::vector<MeasuredTurn>& turns, const Headings& headings) {
  constexpr double kOther = 1;  // [s]
  if (turns.empty() || headings.isEmpty()) return std::nullopt;
  const auto all = trials(turns, headings);
  std::size_t most = 0;
  for (const auto& one : all) most = std::max(most, one.cost.turns);
  const Trial* best = nullptr;
  for (const auto& one : all) {
    if (2 * one.cost.turns < most) continue;
    if (!best || one.cost.mean() < best->cost.mean()) best = &one;
  }
  if (!best) return std::nullopt;
  double other = std::numeric_limits<double>::infinity();
  for (const auto& one : all) {
    const bool is_same = one.sign == best->sign && std::abs(one.offset - best->offset) < kOther;
    if (!is_same && 2 * one.cost.turns >= most) other = std::min(other, one.cost.mean());
  }
  // With noise as large as the turns themselves, a drive that repeats itself fits at wrong offsets, too.
  constexpr double kFar = 1, kMuchBetter = 2.5;  // [s] [-]
  if (advantage(best->cost, other) < kSurelyOffset) return std::nullopt;
  if (std::abs(best->offset) > kFar && other < kMuchBetter * best->cost.mean()) return std::nullopt;
  auto fit = refined(turns, headings, best->offset, best->sign);
  if (fit) fit->drift = driftOf(turns, headings, *fit);
  return fit;
}

}  // namespace omnimapper::check
