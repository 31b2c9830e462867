#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>

#include <string>
#include <vector>

namespace omnimapper::testing {

/// Variants of a log of 2D lasers and wheel odometry, which a mapper should map as well as the original.
enum class LogVariant {
  as_it_is,
  reversed,           ///< the robot drives the same path backwards: order, stamps, odometry and motions are reversed
  every_second_scan,  ///< every second scan of each laser
  every_fourth_scan,  ///< every fourth scan of each laser
  without_wheels,     ///< no odometry at all
  long_wheels,        ///< the wheels measure every distance 5 % too long
  turning_wheels,     ///< the wheels turn to the left by 2 deg in each metre travelled
  narrow_laser,       ///< without a sixth of the beams on either side
  from_the_middle,    ///< the second half of the time
  unseen_slip,        ///< the 5 s of the middle third of the time in which the robot drives farthest have no scans, and
                      ///< the wheels turn by 40 deg too much during them
};

/// All variants, in that order.
const std::vector<LogVariant>& allLogVariants();
/// Name of a variant, such as "every second scan".
std::string nameOf(LogVariant variant);

/// The variant of a log, which must be sorted by stamp. Observations are copied only if they differ.
std::vector<mrpt::obs::CObservation::Ptr> variantOf(const std::vector<mrpt::obs::CObservation::Ptr>& log,
                                                    LogVariant variant);

/// The log up to `from`, then its part from `to` on, which begins `gap` [s] later. To the laser the robot is carried
/// from where it was at `from` to where it was at `to`; its wheels do not notice. With from == to it stands meanwhile.
std::vector<mrpt::obs::CObservation::Ptr> carried(const std::vector<mrpt::obs::CObservation::Ptr>& log,
                                                  base::Stamp from, base::Stamp to, double gap);

/// The stamp at which the reversed log is where the log is at `stamp`, and vice versa.
base::Stamp reversedStamp(const std::vector<mrpt::obs::CObservation::Ptr>& log, base::Stamp stamp);

}  // namespace omnimapper::testing
