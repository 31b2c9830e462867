#pragma once

#include <omnimapper/plugin/Batch.h>

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace omnimapper::mapper {

/// How far the zeros of a pan-tilt unit are off (thesis 4.3.2.5), as one variable of kind "pan_tilt" for each camera
/// and run: the true angles less the reported ones [rad], pan to the left and tilt down, with a prior at zero. What
/// changes from image to image is noise of the measurements. See SensorCorrections for sensors that are mounted askew.
class PanTiltOffsets {
 public:
  /// `sigma` [rad] of each angle before anything is measured; 0: the reported angles have no offset. `owner`: the
  /// plugin's INI section.
  PanTiltOffsets(double sigma, std::string owner) : sigma_(sigma), owner_(std::move(owner)) {}

  /// The variable of a camera; added to `batch` with its prior if it is new, and then provisional. None if the angles
  /// have no offset.
  std::optional<base::VariableId> find(const std::string& label, Batch& batch);
  /// To be called from the plugin's applied(), of every batch that find() was given.
  void applied(const AppliedBatch& ids);

  /// Pan and tilt as they are estimated now; zero for none and for one that is still provisional.
  static Eigen::Vector2d estimate(std::optional<base::VariableId> id, const graph::Graph& graph);

 private:
  double sigma_;
  std::string owner_;
  std::map<std::string, base::VariableId> variables_;  // by sensor label
};

}  // namespace omnimapper::mapper
