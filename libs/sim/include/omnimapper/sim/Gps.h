#pragma once

#include <omnimapper/sim/Sensor.h>

#include <vector>

namespace omnimapper::sim {

struct GpsOptions {
  double origin_latitude = 36.714;    ///< of the map's origin [degrees north]
  double origin_longitude = -4.4785;  ///< [degrees east]
  double origin_altitude = 60;        ///< above the ellipsoid [m]
  double east_from_map = 0;           ///< angle by which the map's x axis is turned from east towards north [rad]
  double sigma = 1.5;                 ///< horizontal standard deviation [m]
  double up_factor = 2;               ///< vertical standard deviation divided by the horizontal one
  double correlation = 30;  ///< time in which the correlation of errors falls to 1/e [s]; 0: errors are independent
  int fix_quality = 1;      ///< in the GGA message: 1 plain, 2 differential, 4 RTK fixed, 5 RTK float
  double hdop = 1;
  int satellites = 9;
  bool needs_sky = false;  ///< no fix where something is above the antenna
  static const base::OptionTable<GpsOptions>& table();
};

/// A satellite receiver: CObservationGPS with a GGA message (WGS84; altitude above the ellipsoid, geoid at 0). Its
/// errors are a Gauss-Markov process in east, north and up, without multipath. If needs_sky is set, the fix quality is
/// 0 where something is above the antenna. The truth has one line for each measurement, with "antenna_in_map" [m],
/// "error_enu" [m] and "fix", which is true if there is a fix.
class Gps : public Sensor {
 public:
  Gps(const GpsOptions& options, const SensorOptions& mount, const SensorContext& context);
  Measurement measure(int k) const override;

 private:
  GpsOptions options_;
  std::vector<Eigen::Vector3d> errors_in_enu_;  // error of each measurement [m]
};

}  // namespace omnimapper::sim
