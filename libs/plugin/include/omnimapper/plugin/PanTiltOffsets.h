#pragma once

#include <omnimapper/plugin/Batch.h>

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace omnimapper::mapper {

/// Zero offsets of pan-tilt units (thesis 4.3.2.5): one variable of kind "pan_tilt" for each camera and run. Its value
/// is the true angles minus the reported ones [rad], pan to the left and tilt down, with a prior at zero. Errors that
/// change from image to image belong to the measurement noise. See SensorCorrections for sensors that are mounted
/// askew.
class PanTiltOffsets {
 public:
  /// `sigma` [rad] is the prior standard deviation of each angle; 0 means that the reported angles have no offset.
  /// `owner` is the plugin's INI section.
  PanTiltOffsets(double sigma, std::string owner) : sigma_(sigma), owner_(std::move(owner)) {}

  /// The variable of a camera. If it is new, it is added to `batch` with its prior, and the id is provisional. None if
  /// the angles have no offset.
  std::optional<base::VariableId> find(const std::string& label, Batch& batch);
  /// The plugin's applied() must call this for every batch that was passed to find().
  void applied(const AppliedBatch& ids);

  /// The current estimate of the pan and tilt offsets [rad]; zero if `id` is none or still provisional.
  static Eigen::Vector2d estimate(std::optional<base::VariableId> id, const graph::Graph& graph);

 private:
  double sigma_;
  std::string owner_;
  std::map<std::string, base::VariableId> variables_;  // by sensor label
};

}  // namespace omnimapper::mapper
