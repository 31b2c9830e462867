#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::players {

/// What a Hokuyo says of itself (SCIP's PP). Steps of the mirror are counted from the right, seen from above.
struct HokuyoModel {
  std::string name = "UTM-30LX";
  int steps_per_turn = 1440;                ///< ARES
  int first = 0, last = 1080, front = 540;  ///< AMIN, AMAX, AFRT [steps]
  int min_mm = 20, max_mm = 30'000;         ///< DMIN, DMAX; a range below DMIN is the code of an error
  int rpm = 2400;                           ///< SCAN, revolutions a minute

  int steps() const { return last - first + 1; }

  /// The model whose steps are the beams of the scan, `rate` [1/s] of them. Throws Error(unreadable_input) if the
  /// spacing of the beams divides no full turn, so that the outermost would be off by more than a tenth of a step, for
  /// more steps than four digits count, and for ranges beyond the 262 m that three characters hold.
  static HokuyoModel fitting(const mrpt::obs::CObservation2DRangeScan& scan, double rate);
};

/// What the device measured at each step from first to last.
struct HokuyoScan {
  std::vector<std::uint32_t> ranges_mm;    ///< below min_mm: nothing was measured
  std::vector<std::uint32_t> intensities;  ///< as many, or none
};

/// Rounded to the millimetre, from right to left; 0 for what is invalid, and for ranges outside the model's.
HokuyoScan hokuyoScan(const mrpt::obs::CObservation2DRangeScan& scan, const HokuyoModel& model);

}  // namespace omnimapper::players
