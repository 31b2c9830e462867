#include "GpsPlugin.h"

#include <mrpt/topography/conversions.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/plugin/SavedVariable.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "AntennaFactor.h"

namespace omnimapper::plugins {

namespace {
constexpr std::uint32_t kSavedGpsVersion = 3;  // version 2 ended with a mark that made it a place on earth, too
}

const base::OptionTable<GpsOptions>& GpsOptions::table() {
  using Options = GpsOptions;
  const auto positive = base::Range::positive();
  static const auto table =
      base::OptionTable<Options>()
          .text("label", &Options::label, "Sensor label of the GPS receiver; empty for every GPS observation.")
          .number("sigma_m", &Options::sigma, positive,
                  "Horizontal standard deviation of a fix without RTK (real-time kinematics) at an HDOP of 1. A larger "
                  "HDOP (horizontal dilution of precision) multiplies this value.")
          .number("sigma_rtk_float_m", &Options::sigma_rtk_float, positive,
                  "Horizontal standard deviation of an RTK fix with float solution, at any HDOP (RTK: real-time "
                  "kinematics; HDOP: horizontal dilution of precision).")
          .number("sigma_rtk_m", &Options::sigma_rtk, positive,
                  "Horizontal standard deviation of an RTK fix with fixed solution, at any HDOP (RTK: real-time "
                  "kinematics; HDOP: horizontal dilution of precision).")
          .number("up_factor", &Options::up_factor, positive,
                  "Ratio of the vertical to the horizontal standard deviation of a fix.")
          .number("max_hdop", &Options::max_hdop, positive,
                  "Largest HDOP (horizontal dilution of precision) of a fix that is used. Fixes with a larger HDOP are "
                  "rejected, because the geometry of their satellites is poor.")
          .number("min_spread_m", &Options::min_spread, positive,
                  "Distance over which the fixes must extend before they are used, because fixes at one place do not "
                  "determine the map's heading.")
          .number("loss_scale", &Options::loss_scale, positive,
                  "Number of standard deviations beyond which a measurement that disagrees loses influence (scale of "
                  "the Cauchy loss).")
          .flag("map_is_enu", &Options::map_is_enu,
                "true: the map frame is the east-north-up frame at origin_latitude, origin_longitude and "
                "origin_altitude_m. false: the pose of the map on the earth is estimated.")
          .number("origin_latitude", &Options::origin_latitude, base::Range{-90, 90},
                  "With map_is_enu = true, latitude of the map's origin [degrees north].")
          .number("origin_longitude", &Options::origin_longitude, base::Range{-180, 180},
                  "With map_is_enu = true, longitude of the map's origin [degrees east].")
          .number("origin_altitude_m", &Options::origin_altitude, {},
                  "With map_is_enu = true, altitude of the map's origin above the ellipsoid (WGS84).");
  return table;
}

GpsPlugin::GpsPlugin(const GpsOptions& options, const mapper::PluginContext& context)
    : options_(options), context_(context) {
  if (options.map_is_enu) origin_ = {options.origin_latitude, options.origin_longitude, options.origin_altitude};
}

bool GpsPlugin::wants(const mrpt::obs::CObservation& observation) const {
  const auto* gps = dynamic_cast<const mrpt::obs::CObservationGPS*>(&observation);
  return gps && gps->has_GGA_datum() && (options_.label.empty() || observation.sensorLabel == options_.label);
}

std::optional<GpsPlugin::Fix> GpsPlugin::read(const mrpt::obs::CObservationGPS& gps, mapper::Decision& decision) {
  const auto& gga = gps.getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
  const double hdop = gga.thereis_HDOP ? static_cast<double>(gga.HDOP) : 1.0;
  decision.numbers = {{"fix quality", static_cast<double>(gga.fix_quality)},
                      {"satellites", static_cast<double>(gga.satellitesUsed)},
                      {"HDOP", hdop}};
  const double altitude = gga.altitude_meters + gga.geoidal_distance;
  if (gga.fix_quality == 0) {
    decision.reason = "no fix";
  } else if (!(hdop <= options_.max_hdop)) {
    decision.reason = "poor satellite geometry";
  } else if (!std::isfinite(gga.latitude_degrees) || !std::isfinite(gga.longitude_degrees) ||
             !std::isfinite(altitude)) {
    decision.reason = "not finite";
  } else if (std::abs(gga.latitude_degrees) > 90 || std::abs(gga.longitude_degrees) > 180) {
    decision.reason = "not a place on the earth";
  } else {
    if (!origin_) origin_ = {gga.latitude_degrees, gga.longitude_degrees, altitude};
    const mrpt::topography::TGeodeticCoords here(gga.latitude_degrees, gga.longitude_degrees, altitude);
    const mrpt::topography::TGeodeticCoords origin(origin_->latitude, origin_->longitude, origin_->altitude);
    mrpt::math::TPoint3D enu;
    mrpt::topography::geodeticToENU_WGS84(here, enu, origin);
    constexpr int kRtkFixed = 4, kRtkFloat = 5;
    double sigma = options_.sigma * std::max(1.0, hdop);
    if (gga.fix_quality == kRtkFixed) sigma = options_.sigma_rtk;
    if (gga.fix_quality == kRtkFloat) sigma = options_.sigma_rtk_float;
    decision.accepted = true;
    decision.reason = "taken";
    decision.numbers.emplace_back("sigma [m]", sigma);
    const auto lever = gps.sensorPose.translation();
    return Fix{decision.from, {lever.x, lever.y, lever.z}, {enu.x, enu.y, enu.z}, sigma};
  }
  return std::nullopt;
}

mapper::Batch GpsPlugin::measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                                 const mapper::View& view) {
  mapper::Batch batch;
  mapper::Decision decision(frame, context_.section, "absolute position");
  const auto fix = read(dynamic_cast<const mrpt::obs::CObservationGPS&>(observed.observation), decision);
  batch.log(decision);
  if (!fix) return batch;
  waiting_.push_back(*fix);
  if (!map_from_enu_) {
    const auto map_from_enu = options_.map_is_enu ? std::make_optional<mrpt::poses::CPose3D>() : alignment(view);
    if (!map_from_enu) return batch;
    map_from_enu_ = batch.addVariable(mapper::poseVariable(context_.motion),
                                      mapper::poseValue(context_.motion, *map_from_enu), options_.map_is_enu);
  }
  for (const auto& waiting : waiting_) batch.addFactor(factor(waiting, view));
  waiting_.clear();
  setPlaceOnEarth(view, batch);
  return batch;
}

mapper::Batch GpsPlugin::atEnd(const mapper::View& view) {
  mapper::Batch batch;
  setPlaceOnEarth(view, batch);
  return batch;
}

// If several receivers have frames of their own, that of the first is the map's.
void GpsPlugin::setPlaceOnEarth(const mapper::View& view, mapper::Batch& batch) const {
  if (!map_from_enu_ || mapper::Batch::isProvisional(*map_from_enu_)) return;
  if (!view.map.layers.find(mapper::PlaceOnEarth::kLayer)) batch.setLayer(place());
}

mapper::PlaceOnEarth GpsPlugin::place() const {
  return {*map_from_enu_, *origin_};
}

void GpsPlugin::applied(const mapper::AppliedBatch& ids) {
  if (!ids.variables.empty()) map_from_enu_ = ids.variables.front();
}

std::optional<map::MapSection> GpsPlugin::save() const {
  if (!map_from_enu_) return std::nullopt;
  return map::MapSection{{}, kSavedGpsVersion, place().toBytes()};
}

void GpsPlugin::restore(const map::MapSection* saved, const mapper::View& view) {
  if (!saved) return;
  mapper::expectVersion(*saved, kSavedGpsVersion);
  std::istringstream in(saved->bytes);
  const auto id = mapper::readVariableId(in, view, saved->name);
  const double latitude = graph::readDouble(in), longitude = graph::readDouble(in), altitude = graph::readDouble(in);
  const bool same_origin = !options_.map_is_enu || (origin_->latitude == latitude && origin_->longitude == longitude &&
                                                    origin_->altitude == altitude);
  if (view.graph.variable(id).fixed != options_.map_is_enu || !same_origin) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "[" + context_.section +
                          "] map_is_enu or its origin differs from that of the map that is "
                          "continued: use the values of that map, or map its log again");
  }
  map_from_enu_ = id;
  origin_ = {latitude, longitude, altitude};
}

graph::FactorRecord GpsPlugin::factor(const Fix& fix, const mapper::View& view) const {
  const bool spatial = context_.motion == mapper::Motion::spatial;
  Eigen::VectorXd sigmas = Eigen::VectorXd::Constant(spatial ? 3 : 2, fix.sigma);
  if (spatial) sigmas[2] *= options_.up_factor;
  graph::FactorRecord record{{*map_from_enu_, view.map.keyFrame(fix.frame).pose},
                             std::make_shared<AntennaFactor>(fix.antenna_in_base, fix.antenna_in_enu, spatial),
                             graph::SquareRootInformation::fromSigmas(sigmas),
                             graph::Loss::cauchy(options_.loss_scale),
                             1,
                             {}};
  record.tags.owner = context_.section;
  return record;
}

namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

// Pose of the east-north-up frame that fits the fixes to the trajectory, by least squares in the plane. If the fixes
// move and the trajectory does not, only the fixes measure the motion, and x of the map points east.
std::optional<mrpt::poses::CPose3D> GpsPlugin::alignment(const mapper::View& view) const {
  Eigen::Vector3d mean_map = Eigen::Vector3d::Zero(), mean_enu = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> in_map;
  for (const auto& fix : waiting_) {
    mrpt::math::TPoint3D point;
    const auto& lever = fix.antenna_in_base;
    view.map.keyFrame(fix.frame).map_from_base.composePoint({lever.x(), lever.y(), lever.z()}, point);
    in_map.emplace_back(point.x, point.y, point.z);
    mean_map += in_map.back() / static_cast<double>(waiting_.size());
    mean_enu += fix.antenna_in_enu / static_cast<double>(waiting_.size());
  }
  constexpr std::size_t kFew = 5;
  constexpr double kStands = 0.1;      // of the fixes' spread: a trajectory with less does not follow them
  constexpr double kBeyondNoise = 10;  // standard deviations of a fix: a larger spread is no noise
  double along = 0, across = 0, spread = 0, sigma = 0;
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const Eigen::Vector3d m = in_map[i] - mean_map, e = waiting_[i].antenna_in_enu - mean_enu;
    along += e.x() * m.x() + e.y() * m.y();
    across += e.x() * m.y() - e.y() * m.x();
    spread = std::max(spread, m.head<2>().norm());
    sigma = std::max(sigma, waiting_[i].sigma);
  }
  // The spread is the median distance from the middle, so that a few outliers do not change it.
  std::vector<double> east, north, far;
  for (const auto& fix : waiting_) {
    east.push_back(fix.antenna_in_enu.x());
    north.push_back(fix.antenna_in_enu.y());
  }
  const Eigen::Vector2d middle(median(east), median(north));
  for (const auto& fix : waiting_) far.push_back((fix.antenna_in_enu.head<2>() - middle).norm());
  const double spread_of_fixes = median(far);
  const bool only_fixes_move = waiting_.size() >= kFew &&
                               2 * spread_of_fixes >= std::max(options_.min_spread, kBeyondNoise * sigma) &&
                               spread < kStands * spread_of_fixes;
  if (2 * spread < options_.min_spread && !only_fixes_move) return std::nullopt;
  const double yaw = only_fixes_move ? 0 : std::atan2(across, along);
  const Eigen::Vector3d turned(std::cos(yaw) * mean_enu.x() - std::sin(yaw) * mean_enu.y(),
                               std::sin(yaw) * mean_enu.x() + std::cos(yaw) * mean_enu.y(), mean_enu.z());
  const Eigen::Vector3d offset = mean_map - turned;
  return mrpt::poses::CPose3D(offset.x(), offset.y(), offset.z(), yaw, 0, 0);
}

void GpsPlugin::registerKinds(mapper::Kinds& kinds) {
  AntennaFactor::addTo(kinds.factors);
}

}  // namespace omnimapper::plugins
