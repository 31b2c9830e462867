#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/plugin/Batch.h>

#include <map>
#include <optional>
#include <string>
#include <utility>

namespace omnimapper::mapper {

/// How far a measurement plugin trusts the reported pose of its sensor on the base. An observation reports this pose,
/// unless the INI gives it instead (SensorPoses). The options struct of a plugin that leaves the choice to its user
/// derives from this one.
struct SensorPoseTrust {
  enum class Estimate {
    no,             ///< the reported pose is exact
    once,           ///< one correction for all key frames of a run: a sensor mounted a little askew
    each_key_frame  ///< one correction for each: a pan-tilt head whose encoders are noisy
  };
  Estimate estimate = Estimate::no;
  double position_sigma = 0.01;                               ///< [m] of the reported pose
  double angle_sigma = base::option_text::kRadiansPerDegree;  ///< [rad] of the reported pose

  /// Adds the keys of this struct to the table of a struct that derives from it.
  template <class Options>
  static base::OptionTable<Options>& declareIn(base::OptionTable<Options>& table);
};

/// The pose of a sensor on the base as a variable with a prior (thesis 5.3.3: static or dynamic transform from sensor
/// to base). The reported pose may differ between key frames, so the variable is a correction to it:
///   base_from_sensor = base_from_reported * reported_from_sensor,
/// kind se3, prior at the identity. A factor that uses this variable binds (pose, reported_from_sensor, ...) and keeps
/// base_from_reported as a measurement.
class SensorCorrections {
 public:
  /// `owner`: the plugin's INI section.
  SensorCorrections(const SensorPoseTrust& trust, std::string owner) : trust_(trust), owner_(std::move(owner)) {}

  /// The variable reported_from_sensor of a sensor at a key frame. If it is new, it is added to `batch` with its prior,
  /// and the id is provisional. None if the reported pose counts as exact.
  std::optional<base::VariableId> find(const std::string& label, base::KeyFrameId frame, Batch& batch);
  /// The plugin's applied() must call this for every batch that was passed to find().
  void applied(const AppliedBatch& ids);

  /// The current estimate of the correction; the identity if `id` is none or still provisional.
  static geometry::Se3 estimate(std::optional<base::VariableId> id, const graph::Graph& graph);
  /// Covariance of the prior in the tangent of the variable; zero if the reported pose counts as exact.
  geometry::Matrix6d priorCovariance() const;

 private:
  using Key = std::pair<std::string, std::optional<base::KeyFrameId>>;  // no key frame: one for all of them

  SensorPoseTrust trust_;
  std::string owner_;
  std::map<Key, base::VariableId> variables_;
};

template <class Options>
base::OptionTable<Options>& SensorPoseTrust::declareIn(base::OptionTable<Options>& table) {
  Estimate Options::*const estimate =
      &SensorPoseTrust::estimate;  // template deduction needs the pointer to be of Options
  return table
      .choice("estimate_sensor_pose", estimate,
              {{"no", Estimate::no}, {"once", Estimate::once}, {"each_key_frame", Estimate::each_key_frame}},
              "Whether a correction of the sensor's place on the base is estimated, for the run or for each key frame.")
      .number("sensor_pose_sigma_m", &Options::position_sigma, base::Range::positive(),
              "Standard deviation of that place, along each axis of the sensor.")
      .number("sensor_pose_sigma_deg", &Options::angle_sigma, base::Range::positive(),
              "Standard deviation of its direction, about each axis of the sensor.");
}

}  // namespace omnimapper::mapper
