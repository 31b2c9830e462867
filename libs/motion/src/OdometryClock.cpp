#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>
#include <omnimapper/motion/OdometryClock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace omnimapper::motion {

namespace {
constexpr std::size_t kKept = 400;  // headings, 20 s
}

void OdometryClock::addTurn(base::Stamp stamp, double turn) {
  constexpr double kInexact = 0.1;  // of a step
  const bool continues = end_ && std::abs(base::secondsBetween(*end_, stamp) - kStep) < kInexact * kStep;
  if (!continues) {
    headings_.assign(1, 0);
    matches_.clear();
  } else {
    headings_.push_back(headings_.back() + turn);
    if (headings_.size() > kKept) headings_.pop_front();
  }
  end_ = stamp;
  while (!matches_.empty() && base::secondsBetween(matches_.front().end, stamp) >= kMost) {
    compare(matches_.front());
    matches_.pop_front();
  }
}

void OdometryClock::addMatch(base::Stamp begin, base::Stamp end, double turn) {
  constexpr double kLongest = 3;  // [s] in which errors of the odometry do not hide the offset
  if (base::secondsBetween(begin, end) <= kLongest) matches_.push_back({begin, end, turn});
}

std::optional<double> OdometryClock::headingAt(base::Stamp stamp) const {
  const double back = base::secondsBetween(stamp, *end_) / kStep;
  const double place = static_cast<double>(headings_.size() - 1) - back;
  if (!(place >= 0) || back < 0) return std::nullopt;
  const auto before = static_cast<std::size_t>(place);
  const double share = place - static_cast<double>(before);
  if (share == 0) return headings_[before];
  return (1 - share) * headings_[before] + share * headings_[before + 1];
}

// Straight motion and steady turns look the same at any offset; they say nothing and are left out.
void OdometryClock::compare(const Turn& match) {
  constexpr double kLeastSpread = 0.035;  // [rad] between the turns that the offsets predict
  constexpr double kMostError = 0.17;     // [rad] of a match that is not simply wrong
  constexpr double kKeptOfErrors = 0.99;
  std::array<double, kOffsets> squared{};
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (int i = 0; i < kOffsets; ++i) {
    const auto offset = base::durationFromSeconds(kMost * (2.0 * i / (kOffsets - 1) - 1));
    const auto from = headingAt(match.begin + offset), to = headingAt(match.end + offset);
    if (!from || !to) return;
    const double turn = *to - *from;
    least = std::min(least, turn);
    most = std::max(most, turn);
    squared[i] = mrpt::square(std::min(kMostError, std::abs(mrpt::math::wrapToPi(turn - match.turn))));
  }
  if (most - least < kLeastSpread) return;
  for (int i = 0; i < kOffsets; ++i) errors_[i] = kKeptOfErrors * errors_[i] + squared[i];
  compared_ = kKeptOfErrors * compared_ + 1;
  choose();
}

// The offset with the least error, by a parabola through its neighbours. Noise also favours some offset, but not by
// much: twice the logarithm of the likelihood ratio of two offsets is n log(E0 / E) for n turns.
void OdometryClock::choose() {
  constexpr double kEnough = 20;    // turns
  constexpr double kSurely = 20;    // of the ratio; a single pair of offsets would need 11 for a probability of 0.001
  constexpr double kLeast = 0.015;  // [s] that is worth a correction
  const auto best = std::min_element(errors_.begin(), errors_.end());
  const auto i = best - errors_.begin();
  offset_ = 0;
  if (compared_ < kEnough || !(compared_ * std::log(errors_[kOffsets / 2] / *best) >= kSurely)) return;
  if (i == 0 || i == kOffsets - 1) return;  // the least may lie beyond
  const double step = 2 * kMost / (kOffsets - 1), before = *(best - 1), after = *(best + 1);
  const double curvature = before + after - 2 * *best;
  const double shift = curvature > 0 ? 0.5 * (before - after) / curvature : 0;
  const double offset = (static_cast<double>(i) + shift) * step - kMost;
  if (std::abs(offset) >= kLeast) offset_ = offset;
}

}  // namespace omnimapper::motion
