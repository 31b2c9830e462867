#pragma once

#include <mrpt/obs/CObservationGPS.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/plugin/PlaceOnEarth.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::plugins {

struct GpsOptions {
  std::string label;             ///< empty: every GPS observation
  double sigma = 3.0;            ///< [m] horizontal, of a plain fix at HDOP 1
  double sigma_rtk_float = 0.4;  ///< [m]
  double sigma_rtk = 0.03;       ///< [m]
  double up_factor = 2.0;        ///< vertical sigma divided by the horizontal one
  double max_hdop = 10;
  double min_spread = 5.0;  ///< [m]
  double loss_scale = 3;    ///< [sigma] of the Cauchy loss
  bool map_is_enu = false;
  double origin_latitude = 0, origin_longitude = 0;  ///< [deg] of the given origin
  double origin_altitude = 0;                        ///< [m] above the ellipsoid

  static const base::OptionTable<GpsOptions>& table();
};

/// GPS fixes (thesis 5.2.2.2) of an antenna whose position on the base (the lever arm) is the observation's sensorPose.
/// The pose of the local east-north-up frame in the map is a variable, which is created once the fixes spread widely
/// enough to determine the heading of that frame. With map_is_enu the map frame is the east-north-up frame at a given
/// origin.
class GpsPlugin : public mapper::MeasurementPlugin {
 public:
  static constexpr const char* kName = "GpsPlugin";
  static constexpr const char* kSummary =
      "Uses GPS fixes. Estimates where the map is on the earth, or places the map at a given origin.";
  static void registerKinds(mapper::Kinds& kinds);

  GpsPlugin(const GpsOptions& options, const mapper::PluginContext& context);

  bool wants(const mrpt::obs::CObservation& observation) const override;
  bool givesAbsolutePoses() const override { return options_.map_is_enu; }
  mapper::Batch measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                        const mapper::View& view) override;
  void applied(const mapper::AppliedBatch& ids) override;
  /// Sets the map's place on earth if no later fix could.
  mapper::Batch atEnd(const mapper::View& view) override;
  /// Saves the origin and the variable map_from_enu.
  std::optional<map::MapSection> save() const override;
  void restore(const map::MapSection* saved, const mapper::View& view) override;

 private:
  struct Fix {
    base::KeyFrameId frame;
    Eigen::Vector3d antenna_in_base, antenna_in_enu;  // [m]
    double sigma;                                     // [m] horizontal
  };

  std::optional<Fix> read(const mrpt::obs::CObservationGPS& gps, mapper::Decision& decision);
  graph::FactorRecord factor(const Fix& fix, const mapper::View& view) const;
  void setPlaceOnEarth(const mapper::View& view, mapper::Batch& batch) const;
  mapper::PlaceOnEarth place() const;
  std::optional<mrpt::poses::CPose3D> alignment(const mapper::View& view) const;

  GpsOptions options_;
  mapper::PluginContext context_;
  std::optional<mapper::Geodetic> origin_;
  std::vector<Fix> waiting_;  // wait until map_from_enu exists
  std::optional<base::VariableId> map_from_enu_;
};

}  // namespace omnimapper::plugins
