#pragma once

#include <omnimapper/plugin/Association.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::plugins {

struct PointLandmarksOptions : mapper::AssociationOptions {
  std::string label;       ///< empty: every range-bearing sensor
  double sigma_range = 0;  ///< [m] 0: as the observation reports
  double sigma_yaw = 0;    ///< [rad] 0: as the observation reports
  double sigma_pitch = 0;  ///< [rad] 0: as the observation reports
  double loss_scale = 3;   ///< [sigma] of the Huber loss

  static const base::OptionTable<PointLandmarksOptions>& table();
};

/// Points as landmarks, measured by ranges and bearings (mrpt::obs::CObservationBearingRange, thesis 4.6.2.1): points
/// of the plane by range and yaw in a planar map, points in space by range, yaw and pitch in a spatial one. A
/// measurement that reports a number is of the landmark with that number. If it does not fit this landmark, the
/// measurement is kept in the graph with weight 0, so that the search for moved landmarks finds it. A measurement
/// without a number (id -1) is associated, and landmarks that turn out to be the same point are merged.
class PointLandmarksPlugin : public mapper::MeasurementPlugin {
 public:
  PointLandmarksPlugin(const PointLandmarksOptions& options, const mapper::PluginContext& context);
  ~PointLandmarksPlugin() override;

  bool wants(const mrpt::obs::CObservation& observation) const override;
  mapper::Batch measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                        const mapper::View& view) override;
  void applied(const mapper::AppliedBatch& ids) override;
  mapper::FollowUp afterCommit(const map::KeyFrame& frame, const mapper::View& view) override;
  mapper::Batch atEnd(const mapper::View& view) override;
  void restore(const map::MapSection* saved, const mapper::View& view) override;

 private:
  class Associator;

  PointLandmarksOptions options_;
  mapper::PluginContext context_;
  std::unique_ptr<class PointLandmarkIndex> known_;
  std::size_t merged_at_solve_ = 0;
};

class PointLandmarksPluginFactory : public mapper::MeasurementPluginFactory {
  DEFINE_MRPT_OBJECT(PointLandmarksPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "PointLandmarksPlugin"; }
  std::string summary() const override {
    return "Points and markers as landmarks, measured by their ranges and bearings.";
  }
  const std::vector<base::OptionSpec>& options() const override { return PointLandmarksOptions::table().specs(); }
  void registerKinds(mapper::Kinds& kinds) const override;
  std::unique_ptr<mapper::MeasurementPlugin> make(const base::ConfigSection& section,
                                                  const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
