#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/Stamp.h>

#include <string>

/// Hand-made observations for the tests of live.
namespace omnimapper::live::observations {

/// A time in 2026, as of the host's clock.
inline const base::Stamp kNow = base::stampFromUnix(1.79e9);

inline base::Stamp at(double seconds) {
  return kNow + base::durationFromSeconds(seconds);
}

inline mrpt::obs::CObservationOdometry odometry(double seconds, double x = 0) {
  mrpt::obs::CObservationOdometry odometry;
  odometry.timestamp = at(seconds);
  odometry.sensorLabel = "wheels";
  odometry.odometry = mrpt::poses::CPose2D(x, 0, 0);
  return odometry;
}

inline mrpt::obs::CObservationImage image(double seconds, const std::string& label = "camera") {
  mrpt::obs::CObservationImage image;
  image.timestamp = at(seconds);
  image.sensorLabel = label;
  image.image.resize(64, 48, mrpt::img::CH_RGB);
  image.image.filledRectangle(0, 0, 63, 47, mrpt::img::TColor(80, 120, 40));
  return image;
}

}  // namespace omnimapper::live::observations
