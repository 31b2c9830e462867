#pragma once

#include <omnimapper/landmarks/LandmarkPlugin.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>
#include <vector>

#include "KnownPoint.h"
#include "PointLandmarksOptions.h"

namespace omnimapper::plugins {

/// Points as landmarks, measured by ranges and bearings (mrpt::obs::CObservationBearingRange, thesis 4.6.2.1): points
/// of the plane by range and yaw in a planar map, points in space by range, yaw and pitch in a spatial one. A
/// measurement that reports a number is of the landmark with that number. If it does not fit this landmark, the
/// measurement is kept in the graph with weight 0, so that the search for moved landmarks finds it. A measurement
/// without a number (id -1) is associated, and landmarks that turn out to be the same point are merged.
class PointLandmarksPlugin : public landmarks::LandmarkPlugin<PointLandmarkIndex> {
 public:
  static constexpr const char* kName = "PointLandmarksPlugin";
  static constexpr const char* kSummary = "Points and markers as landmarks, measured by their ranges and bearings.";
  static void registerKinds(mapper::Kinds& kinds);

  PointLandmarksPlugin(const PointLandmarksOptions& options, const mapper::PluginContext& context)
      : LandmarkPlugin(PointLandmarkIndex(context.section)), options_(options), context_(context) {}

  bool wants(const mrpt::obs::CObservation& observation) const override;

 protected:
  mapper::Batch associate(const map::KeyFrame& frame, const mapper::Observed& observed,
                          const mapper::View& view) override;
  mapper::Batch merge(const mapper::View& view) override;

 private:
  PointLandmarksOptions options_;
  mapper::PluginContext context_;
};

}  // namespace omnimapper::plugins
