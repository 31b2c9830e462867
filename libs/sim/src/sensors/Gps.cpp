#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/topography/conversions.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/sim/Gps.h>

#include <cmath>

#include "TruthText.h"

namespace omnimapper::sim {

namespace {

constexpr std::uint64_t kErrorStream = 1;

// The inverse of geodeticToENU_WGS84, which readers of logs use, by Newton's method with the derivative of a sphere.
// MRPT's own inverse (ENUToGeocentric, geocentricToGeodetic) is wrong by 0.2 m of height.
mrpt::topography::TGeodeticCoords geodeticFromEnu(const Eigen::Vector3d& in_enu,
                                                  const mrpt::topography::TGeodeticCoords& origin) {
  constexpr double kEarthRadius = 6.371e6;  // [m]
  const double metres_per_degree = kEarthRadius * base::option_text::kRadiansPerDegree;
  const double shrunk = std::cos(origin.lat.decimal_value * base::option_text::kRadiansPerDegree);
  mrpt::topography::TGeodeticCoords here = origin;
  for (int i = 0; i < 12; ++i) {
    mrpt::math::TPoint3D reached;
    mrpt::topography::geodeticToENU_WGS84(here, reached, origin);
    here.lon.decimal_value += (in_enu.x() - reached.x) / (metres_per_degree * shrunk);
    here.lat.decimal_value += (in_enu.y() - reached.y) / metres_per_degree;
    here.height += in_enu.z() - reached.z;
  }
  return here;
}

}  // namespace

const base::OptionTable<GpsOptions>& GpsOptions::table() {
  using base::Range;
  using Options = GpsOptions;
  static const auto table =
      base::OptionTable<Options>()
          .number("origin_latitude", &Options::origin_latitude, {-89.9, 89.9},
                  "Latitude of the map's origin [degrees north].")
          .number("origin_longitude", &Options::origin_longitude, {-180, 180},
                  "Longitude of the map's origin [degrees east].")
          .number("origin_altitude_m", &Options::origin_altitude, {-500, 10000},
                  "Altitude of the map's origin above the ellipsoid.")
          .number("map_heading_deg", &Options::east_from_map, {},
                  "Angle by which the map's x axis is turned from east towards north.")
          .number("sigma_m", &Options::sigma, Range::notNegative(),
                  "Standard deviation of the horizontal position error, on each axis.")
          .number("up_factor", &Options::up_factor, Range::notNegative(),
                  "Ratio of the vertical to the horizontal standard deviation of the position error.")
          .number("correlation_s", &Options::correlation, Range::notNegative(),
                  "Time in which the correlation of position errors falls to 1/e. With 0 the errors are independent.")
          .integer("fix_quality", &Options::fix_quality, {1, 8},
                   "Fix quality that the GGA message reports: 1 plain, 4 RTK, 5 RTK float.")
          .number("hdop", &Options::hdop, Range::positive(),
                  "Horizontal dilution of precision that the GGA message reports.")
          .integer("satellites", &Options::satellites, {0, 100}, "Number of satellites that the GGA message reports.")
          .flag("needs_sky", &Options::needs_sky, "There is no fix while something is above the antenna.");
  return table;
}

Gps::Gps(const GpsOptions& options, const SensorOptions& mount, const SensorContext& context)
    : Sensor(mount, context), options_(options) {
  const double kept = options.correlation > 0 ? std::exp(-1 / (mount.rate * options.correlation)) : 0;
  for (int k = 0; k < count(); ++k) {
    Random random = randomOf(k, kErrorStream);
    const double fresh = options.sigma * (k == 0 ? 1 : std::sqrt(1 - kept * kept));
    const double east = random.gaussian(fresh), north = random.gaussian(fresh);
    const Eigen::Vector3d driving_noise(east, north, random.gaussian(fresh * options.up_factor));
    errors_in_enu_.push_back(k == 0 ? driving_noise : Eigen::Vector3d(kept * errors_in_enu_.back() + driving_noise));
  }
}

Measurement Gps::measure(int k) const {
  const Eigen::Vector3d antenna_in_map = mapFromSensor(timeOf(k)).translation;
  const Eigen::Vector3d in_enu =
      Eigen::AngleAxisd(options_.east_from_map, Eigen::Vector3d::UnitZ()) * antenna_in_map + errors_in_enu_[k];
  const bool has_fix =
      !options_.needs_sky || !context().scenes->at(timeOf(k)).cast({antenna_in_map, Eigen::Vector3d::UnitZ()}).isHit();

  const auto here =
      geodeticFromEnu(in_enu, {options_.origin_latitude, options_.origin_longitude, options_.origin_altitude});

  mrpt::obs::gnss::Message_NMEA_GGA gga;
  auto gps = mrpt::obs::CObservationGPS::Create();
  stamp(*gps, k);
  gps->has_satellite_timestamp = true;
  gps->originalReceivedTimestamp = gps->timestamp;
  gps->sensorPose = geometry::toMrpt(baseFromSensor());
  mrpt::system::TTimeParts time;
  mrpt::system::timestampToParts(gps->timestamp, time);
  gga.fields.UTCTime.hour = time.hour;
  gga.fields.UTCTime.minute = time.minute;
  gga.fields.UTCTime.sec = time.second;
  gga.fields.fix_quality = static_cast<std::uint8_t>(has_fix ? options_.fix_quality : 0);
  gga.fields.satellitesUsed = static_cast<std::uint32_t>(has_fix ? options_.satellites : 0);
  gga.fields.thereis_HDOP = has_fix;
  if (has_fix) {
    gga.fields.latitude_degrees = here.lat.decimal_value;
    gga.fields.longitude_degrees = here.lon.decimal_value;
    gga.fields.altitude_meters = gga.fields.orthometric_altitude = gga.fields.corrected_orthometric_altitude =
        here.height;
    gga.fields.HDOP = static_cast<float>(options_.hdop);
  }
  gps->setMsg(gga);
  const auto list = [](const Eigen::Vector3d& v) {
    return nlohmann::ordered_json{rounded(v.x()), rounded(v.y()), rounded(v.z())};
  };
  const nlohmann::ordered_json line{
      {"antenna_in_map", list(antenna_in_map)}, {"error_enu", list(errors_in_enu_[k])}, {"fix", has_fix}};
  return {gps, line.dump(), {}};
}

}  // namespace omnimapper::sim
