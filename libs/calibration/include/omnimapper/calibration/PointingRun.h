#pragma once

#include <omnimapper/calibration/CalibrationRun.h>
#include <omnimapper/interaction/readBody.h>

namespace omnimapper::calibration {

struct PointingRequest {
  std::vector<std::string> logs;       ///< with skeletons
  std::string gestures;                ///< table of who points at what and when, see readPointedGestures()
  std::string label;                   ///< label of the tracker; empty: all skeletons
  std::string output;                  ///< output folder
  interaction::SkeletonFormat format;  ///< of the tracker
};

/// Measures from recordings of people who point at known targets how far they miss (thesis 6.1.5, 6.1.6), and writes
/// pointing.csv, the tables for `[labels] pointing_errors`, report.txt and pointing.svg to a folder. Throws base::Error
/// with file, place and remedy if a gesture has no skeleton, or the errors cannot be measured; then nothing is written.
CalibrationResult runPointingCalibration(const PointingRequest& request, base::Progress& progress,
                                         const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
