#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::plugins {

struct RelationsOptions {
  bool point_on_wall = true, parallel = true, perpendicular = true, aligned = true;
  double distance_sigma = 0.02;  ///< [m] of points from their surface, and of walls from their common line
  double angle_sigma = 1 * base::option_text::kRadiansPerDegree;  ///< [rad]
  double max_distance = 1;                                        ///< [m] largest at which a relation is considered
  double max_angle = 15 * base::option_text::kRadiansPerDegree;   ///< [rad]
  double min_likelihood_ratio = 2;
  int min_measurements = 3;  ///< of each landmark

  static const base::OptionTable<RelationsOptions>& table();
};

/// Relations between landmarks as virtual measurements (thesis 4.5): points that lie within the outline of a surface,
/// such as a sign on its wall or an object on its table, and walls that are perpendicular, parallel or on one line.
/// Relations that are likely are proposed after each solve, for the landmarks of all plugins (a landmark with a single
/// point as its variable counts as a point). They are hypotheses: the consistency test refuses those that do not fit,
/// and takes back those that no longer fit. Landmarks of a session that is not aligned with the map get no relations
/// with those of other sessions.
class RelationsPlugin : public mapper::MeasurementPlugin {
 public:
  static constexpr const char* kName = "RelationsPlugin";
  static constexpr const char* kSummary =
      "Relates landmarks as is usual in buildings: points on walls, right angles, walls on one line.";
  static void registerKinds(mapper::Kinds& kinds);

  RelationsPlugin(const RelationsOptions& options, const mapper::PluginContext& context);
  ~RelationsPlugin() override;

  bool wants(const mrpt::obs::CObservation&) const override { return false; }
  bool worksOnLandmarks() const override { return true; }
  mapper::Batch measure(const map::KeyFrame&, const mapper::Observed&, const mapper::View&) override { return {}; }
  mapper::FollowUp afterCommit(const map::KeyFrame& frame, const mapper::View& view) override;
  mapper::Batch atEnd(const mapper::View& view) override;

 private:
  mapper::Batch propose(const mapper::View& view);

  RelationsOptions options_;
  std::string section_;
  std::size_t solves_ = 0;
};

}  // namespace omnimapper::plugins
