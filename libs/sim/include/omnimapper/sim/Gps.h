#pragma once

#include <omnimapper/sim/Sensor.h>

#include <vector>

namespace omnimapper::sim {

struct GpsOptions {
  double origin_latitude = 36.714;    ///< of the map's origin [degrees north]
  double origin_longitude = -4.4785;  ///< [degrees east]
  double origin_altitude = 60;        ///< above the ellipsoid [m]
  double east_from_map = 0;           ///< by how much the map's x axis is turned from east to north [rad]
  double sigma = 1.5;                 ///< horizontal standard deviation [m]
  double up_factor = 2;               ///< vertical over horizontal
  double correlation = 30;            ///< after this time errors are those of then to 1/e only [s]; 0: each anew
  int fix_quality = 1;                ///< as GGA tells it: 1 plain, 2 differential, 4 RTK fixed, 5 RTK float
  double hdop = 1;
  int satellites = 9;
  bool needs_sky = false;  ///< no fix where something is above the antenna
  static const base::OptionTable<GpsOptions>& table();
};

/// A satellite receiver: CObservationGPS with a GGA message (WGS84; altitude above the ellipsoid, geoid at 0). Its
/// errors are a Gauss-Markov process in east, north and up, without multipath. Without sky its fix quality is 0. Truth,
/// one line each: "antenna_in_map" [m], "error_enu" [m].
class Gps : public Sensor {
 public:
  Gps(const GpsOptions& options, const SensorOptions& mount, const SensorContext& context);
  Measurement measure(int k) const override;

 private:
  GpsOptions options_;
  std::vector<Eigen::Vector3d> errors_in_enu_;  // of each measurement [m]
};

}  // namespace omnimapper::sim
