#pragma once

#include <Eigen/Core>
#include <deque>

namespace omnimapper::matching {

/// Compares two sources of motion over spans of 0.5, 2 and 8 s. From scan to scan a contradiction of scans and wheels
/// may be too small to tell: somebody who walks before the robot pulls each match by less than its standard deviation,
/// but always backwards. Over a span such pulls add up, while random errors do not.
class SpanContradiction {
 public:
  /// Adds the part of a difference between the sources that was not followed, with the covariance of the difference
  /// [m] [m2], in a frame that does not turn. `seconds`: time, which must increase. Returns what must be added to the
  /// covariance of this motion, so that over the span it covers both sources; zero if they do not contradict.
  Eigen::Matrix2d add(double seconds, const Eigen::Vector2d& difference, const Eigen::Matrix2d& covariance);

  /// Forgets the differences, because the frame of the next ones is another.
  void interrupt() { recent_.clear(); }

  double contradictedSeconds() const { return contradicted_seconds_; }  ///< [s] in all
  double firstSeconds() const { return first_seconds_; }                ///< [s] time of the first contradiction
  double largest() const { return largest_; }                           ///< [m] over one span

 private:
  struct Difference {
    double seconds;
    Eigen::Vector2d difference;
    Eigen::Matrix2d covariance;
  };
  std::deque<Difference> recent_;  // of the last 8 s
  double contradicted_seconds_ = 0, first_seconds_ = 0, largest_ = 0;
};

}  // namespace omnimapper::matching
