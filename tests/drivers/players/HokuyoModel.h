#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::players {

/// The parameters that a Hokuyo reports (SCIP's PP). Steps of the mirror are counted from the right, seen from above.
struct HokuyoModel {
  std::string name = "UTM-30LX";
  int steps_per_turn = 1440;                ///< ARES
  int first = 0, last = 1080, front = 540;  ///< AMIN, AMAX, AFRT [steps]
  int min_mm = 20, max_mm = 30'000;         ///< DMIN, DMAX; a range below DMIN is an error code
  int rpm = 2400;                           ///< SCAN, revolutions a minute

  int steps() const { return last - first + 1; }

  /// The model whose steps are the beams of the scan, with `rate` [1/s] scans. Throws Error(unreadable_input) if a full
  /// turn is no multiple of the beams' spacing, so that the outermost beam would be off by more than a tenth of a step,
  /// if there are more steps than four digits can count, or ranges beyond the 262 m that three characters can hold.
  static HokuyoModel fitting(const mrpt::obs::CObservation2DRangeScan& scan, double rate);
};

/// The measurements of the device at each step from first to last.
struct HokuyoScan {
  std::vector<std::uint32_t> ranges_mm;    ///< below min_mm: no measurement
  std::vector<std::uint32_t> intensities;  ///< as many as ranges, or none
};

/// The scan rounded to the millimetre, from right to left; 0 for invalid ranges, and for those outside the model's
/// limits.
HokuyoScan hokuyoScan(const mrpt::obs::CObservation2DRangeScan& scan, const HokuyoModel& model);

}  // namespace omnimapper::players
