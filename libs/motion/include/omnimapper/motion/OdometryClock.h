#pragma once

#include <omnimapper/base/Stamp.h>

#include <array>
#include <deque>
#include <optional>

namespace omnimapper::motion {

/// Estimates by how much the stamps of an odometry differ from those of a laser, from the headings of both: a base that
/// begins or ends a turn does so at one time. Only a constant offset of up to kMost is found.
class OdometryClock {
 public:
  static constexpr double kMost = 0.5;  ///< [s] largest offset

  /// Adds the turn [rad] that the odometry measured from the last stamp that was added to this one. Stamps increase by
  /// kStep; one that does not continues nothing, and its turn is ignored.
  void addTurn(base::Stamp stamp, double turn);
  /// Stamp of the newest turn; none before the first one.
  std::optional<base::Stamp> end() const { return end_; }
  /// Adds the turn [rad] between two stamps of the laser as scans measured it. It is compared once turns up to kMost
  /// after `end` were added.
  void addMatch(base::Stamp begin, base::Stamp end, double turn);
  /// The stamp of the odometry minus that of the laser for the same moment [s]; 0 unless an offset explains the turns
  /// much better.
  double offset() const { return offset_; }

  static constexpr double kStep = 0.05;  ///< [s] from one turn to the next

 private:
  static constexpr int kOffsets = 51;  // that are compared, kMost to either side of 0
  struct Turn {
    base::Stamp begin, end;
    double turn;
  };
  std::optional<double> headingAt(base::Stamp stamp) const;
  void compare(const Turn& match);
  void choose();

  std::optional<base::Stamp> end_;
  std::deque<double> headings_;            // [rad] every kStep, up to end_
  std::deque<Turn> matches_;               // not yet compared
  std::array<double, kOffsets> errors_{};  // [rad2] sums for each offset, older ones fade
  double compared_ = 0;                    // number of turns in these sums
  double offset_ = 0;
};

}  // namespace omnimapper::motion
