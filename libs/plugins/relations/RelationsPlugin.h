#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::plugins {

struct RelationsOptions {
  bool point_on_wall = true, parallel = true, perpendicular = true, aligned = true;
  double distance_sigma = 0.02;  ///< [m] of a point from its surface, of walls from one line
  double angle_sigma = 1 * base::option_text::kRadiansPerDegree;  ///< [rad]
  double max_distance = 1;                                        ///< [m] what is farther off is not even asked
  double max_angle = 15 * base::option_text::kRadiansPerDegree;   ///< [rad]
  double min_likelihood_ratio = 2;
  int min_measurements = 3;  ///< of each landmark

  static const base::OptionTable<RelationsOptions>& table();
};

/// Relations between landmarks as virtual measurements (thesis 4.5): points that lie on a surface, a sign's on its wall
/// or an object's on its table, within its outline; walls at right angles, in parallel or on one line. They are
/// proposed by likelihood after each solve, of whatever plugins the landmarks are (a variable of one point is a point),
/// and are hypotheses: the consistency test refuses what does not fit, and takes back what no longer does. A session
/// that nothing has joined to the map gets none with landmarks of others.
class RelationsPlugin : public mapper::MeasurementPlugin {
 public:
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

class RelationsPluginFactory : public mapper::MeasurementPluginFactory {
  DEFINE_MRPT_OBJECT(RelationsPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "RelationsPlugin"; }
  std::string summary() const override { return "What buildings are like: points on walls, right angles, one line."; }
  const std::vector<base::OptionSpec>& options() const override { return RelationsOptions::table().specs(); }
  void registerKinds(mapper::Kinds& kinds) const override;
  std::unique_ptr<mapper::MeasurementPlugin> make(const base::ConfigSection& section,
                                                  const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
