#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>

#include <string>
#include <vector>

namespace omnimapper::testing {

/// A log of 2D lasers and wheel odometry made into another that a mapper should cope with as well.
enum class LogVariant {
  as_it_is,
  reversed,           ///< the robot drives the same way back: order, stamps, odometry and motions
  every_second_scan,  ///< of each laser
  every_fourth_scan,  ///< of each laser
  without_wheels,     ///< no odometry at all
  long_wheels,        ///< the wheels measure every distance 5 % too long
  turning_wheels,     ///< the wheels turn to the left by 2 deg in each metre travelled
  narrow_laser,       ///< without the outer third of the beams, a sixth on either side
  from_the_middle,    ///< the second half of the time
  unseen_slip,        ///< where the robot drives farthest within 5 s of the middle third of the time, these are without
                      ///< scans, and the wheels turn by 40 deg too far meanwhile
};

/// All of them, in that order.
const std::vector<LogVariant>& allLogVariants();
/// Such as "every second scan".
std::string nameOf(LogVariant variant);

/// The variant of a log that is sorted by stamp. The observations are copies where they differ.
std::vector<mrpt::obs::CObservation::Ptr> variantOf(const std::vector<mrpt::obs::CObservation::Ptr>& log,
                                                    LogVariant variant);

/// When the reversed log is where the log was at a stamp, and the other way round.
base::Stamp reversedStamp(const std::vector<mrpt::obs::CObservation::Ptr>& log, base::Stamp stamp);

}  // namespace omnimapper::testing
