#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/landmarks/LandmarkAssociator.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <optional>
#include <string>
#include <utility>

#include "KnownPoint.h"
#include "PointLandmarksOptions.h"
#include "PointMeasurement.h"

namespace omnimapper::plugins {

/// The measurements of one observation, for PointLandmarksPlugin: those with a number are of the landmark of this
/// number, all others are associated.
class PointAssociator : public landmarks::LandmarkAssociator<PointMeasurement> {
 public:
  /// `label`: of the sensor. All references must outlive this object.
  PointAssociator(const PointLandmarksOptions& options, const mapper::PluginContext& context,
                  const PointLandmarkIndex& known, const map::KeyFrame& frame, const mapper::View& view,
                  std::string label);

 protected:
  void describe(const PointMeasurement& measurement, mapper::Decision& decision) const override;
  std::string whyUseless(const PointMeasurement& measurement) const override { return measurement.why_useless; }
  bool isIdentified(const PointMeasurement& measurement) const override { return measurement.number >= 0; }
  std::vector<base::LandmarkId> candidates(const PointMeasurement& measurement) override;
  graph::FactorRecord record(const PointMeasurement& measurement, base::VariableId point) const override;
  std::shared_ptr<const map::LandmarkPayload> learned(const PointMeasurement& measurement,
                                                      const landmarks::LandmarkIds& known) override;
  void addNew(const PointMeasurement& measurement, mapper::Decision decision) override;

 private:
  bool isNear(const PointConstraint& constraint, base::VariableId variable);
  // Standard deviation [m] of a point at this distance [m] from the base, due to the uncertainty of the base's pose.
  double poseSigma(double range);

  const PointLandmarksOptions& options_;
  const mapper::PluginContext& context_;
  const PointLandmarkIndex& known_;
  const geometry::Se3 map_from_base_;
  const std::string label_;
  std::optional<std::pair<double, double>> pose_variances_;  // of the position [m^2], of the rotation [rad^2]
};

}  // namespace omnimapper::plugins
