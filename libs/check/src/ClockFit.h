#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/check/LogFacts.h>

#include <functional>
#include <optional>
#include <vector>

namespace omnimapper::check {

/// The heading of one sensor over its own time, at equal steps.
class Headings {
 public:
  static constexpr double kStep = 0.02;  ///< [s]

  /// Adds the turn [rad] from the last stamp that was added to this one. Across a pause of more than a second the turn
  /// is not known. A stamp that is not later than the last one is ignored.
  void add(base::Stamp stamp, double turn);
  bool isEmpty() const { return headings_.empty(); }
  base::Stamp begin() const { return first_; }
  base::Stamp end() const { return last_; }
  /// Turn [rad] between two times, linearly interpolated; NaN where the heading is not known.
  double turn(base::Stamp begin, base::Stamp end) const;

 private:
  double at(double seconds) const;

  base::Stamp first_, last_;
  std::vector<double> headings_;    // [rad] every kStep from first_ on; NaN in a pause
  std::vector<std::size_t> parts_;  // indices in headings_ at which a pause ends
  double heading_ = 0;              // at last_
};

/// Headings from a function that gives the turn [rad] between two successive stamps, NaN where it is not known.
Headings headingsOf(std::vector<base::Stamp> stamps, const std::function<double(base::Stamp, base::Stamp)>& turn);

/// A turn about the vertical axis that another sensor measured between two stamps of its clock.
struct MeasuredTurn {
  base::Stamp begin, end;
  double turn = 0;  ///< [rad]
};

/// The offset of the headings' clock against that of the turns, of up to kMostOffset to either side, at which the
/// headings explain the turns best. None unless this offset explains them much better than every other one that differs
/// by a second or more, which takes a motion with turns that begin and end at irregular times.
std::optional<ClockFacts> fitClock(const std::vector<MeasuredTurn>& turns, const Headings& headings);

constexpr double kMostOffset = 310;  ///< [s]

}  // namespace omnimapper::check
