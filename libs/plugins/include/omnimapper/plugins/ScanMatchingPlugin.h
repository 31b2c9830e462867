#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/mapper/PluginFactory.h>
#include <omnimapper/matching/IcpMatcher.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::plugins {

struct ScanMatchingOptions {
  std::vector<std::string> labels;  ///< of the clouds; empty: every cloud made from a 2D scan
  int local_frames = 8;
  double min_overlap = 0.6;
  double max_correction = 0.5;                                               ///< [m]
  double max_turn_correction = 20.0 * base::option_text::kRadiansPerDegree;  ///< [rad]
  double point_sigma = 0.05;                                                 ///< [m]
  double wall_sigma_factor = 4;
  double position_sigma_floor = 0.01;                                     ///< [m]
  double angle_sigma_floor = 0.2 * base::option_text::kRadiansPerDegree;  ///< [rad]

  bool close_loops = true;
  double loop_radius = 6.0;   ///< [m]
  double loop_min_way = 8.0;  ///< [m]
  int loop_frames = 4;
  int loop_candidates = 2;
  double loop_min_overlap = 0.75;
  double loop_max_distance = 2.0;                                                 ///< [m]
  double loop_max_correction = 4.0;                                               ///< [m]
  double loop_max_turn_correction = 30.0 * base::option_text::kRadiansPerDegree;  ///< [rad]
  double loop_max_chi2 = 60;
  double loop_loss_scale = 2.0;  ///< [sigma] of the Cauchy loss

  static const base::OptionTable<ScanMatchingOptions>& table();
};

/// 2D scan matching (thesis 5.3.3.2): each key frame's scan against the few before it, and against places seen long
/// ago to close loops. Scans are matched in the plane of the base; in a spatial map z, roll and pitch stay open.
class ScanMatchingPlugin : public mapper::MeasurementPlugin {
 public:
  ScanMatchingPlugin(const ScanMatchingOptions& options, const matching::IcpOptions& icp,
                     const mapper::PluginContext& context);

  bool wants(const mrpt::obs::CObservation& observation) const override;
  mapper::Batch measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                        const mapper::View& view) override;

 private:
  /// What one sensor saw at one key frame.
  struct Seen {
    base::KeyFrameId id;
    matching::PlanarScan scan_in_base;
    double way;  // [m] driven until here
  };
  using History = std::vector<Seen>;

  void matchSequential(const map::KeyFrame& frame, const History& history, const mapper::View& view,
                       mapper::Batch& batch) const;
  void closeLoops(const map::KeyFrame& frame, const History& history, const mapper::View& view, mapper::Batch& batch);
  /// Squared Mahalanobis distance of a match from the prediction, whose covariance is `predicted`.
  double innovation(const matching::ScanMatch& match, const mrpt::math::TPose2D& guess,
                    const graph::FactorRecord& closure, const Eigen::Matrix<double, 6, 6>& predicted) const;
  std::vector<std::size_t> loopCandidates(const map::KeyFrame& frame, const History& history,
                                          const mapper::View& view) const;
  matching::PlanarScan localMap(const History& history, std::size_t first, std::size_t last, std::size_t centre,
                                const mapper::View& view) const;

  /// Limits a match has to keep.
  struct Gate {
    double min_overlap, max_correction, max_turn_correction;
  };
  mapper::Decision judge(const matching::ScanMatch& match, const mrpt::math::TPose2D& guess, const Gate& gate) const;
  graph::FactorRecord factor(base::VariableId reference, base::VariableId scan, const matching::ScanMatch& match) const;

  ScanMatchingOptions options_;
  mapper::PluginContext context_;
  matching::IcpMatcher sequential_matcher_;
  matching::IcpMatcher loop_matcher_;
  std::map<std::string, History> histories_;  // by label
};

class ScanMatchingPluginFactory : public mapper::MeasurementPluginFactory {
  DEFINE_MRPT_OBJECT(ScanMatchingPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "ScanMatchingPlugin"; }
  std::string summary() const override { return "Matches 2D scans in sequence and to close loops, by MRPT's ICP."; }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<mapper::MeasurementPlugin> make(const base::ConfigSection& section,
                                                  const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
