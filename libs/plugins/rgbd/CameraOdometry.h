#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/camera/LensStraightener.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/motion/Gyroscope.h>
#include <omnimapper/motion/PoseTimeline.h>
#include <omnimapper/motion/PredictedMotion.h>
#include <omnimapper/motion/WheelOdometry.h>
#include <omnimapper/plugin/PosePlugin.h>

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "StraightImage.h"
#include "returnEvidence.h"

namespace omnimapper::plugins {

struct CameraOdometryOptions {
  std::string label;           ///< of the camera; empty: the first one observed
  std::string odometry_label;  ///< of the wheel odometry used for prediction; empty: the first one observed
  std::string imu_label;       ///< of the gyroscope used for prediction; empty: the first one observed
  double turn_rate_noise = motion::GyroscopeOptions{}.noise_per_root_s;  ///< [rad / sqrt(s)]
  double turn_rate_bias = motion::GyroscopeOptions{}.bias_sigma;         ///< [rad/s]
  double max_speed = 1.5;                                            ///< [m/s] of a camera; faster motions are errors
  double position_noise = 0.001;                                     ///< [m] between two images
  double angle_noise = 0.05 * base::option_text::kRadiansPerDegree;  ///< [rad] between two images
  double position_noise_per_root_m = 0.01;                           ///< [m / sqrt(m)]
  double position_noise_per_root_turn = 0.01;                        ///< [m / sqrt(rad)]
  double angle_noise_per_root_m = 0.5 * base::option_text::kRadiansPerDegree;  ///< [rad / sqrt(m)]
  double angle_noise_per_root_turn = 0.013;                                    ///< [rad / sqrt(rad)]

  static const base::OptionTable<CameraOdometryOptions>& table();
};

/// The result of tracking one image.
struct ImageMotion {
  enum class How {
    begun,
    tracked,
    found,  ///< found again after a loss: the motion spans the images that were lost
    lost,
  };
  How how = How::lost;
  geometry::Se3 last_from_camera;  ///< motion since the image that was tracked before, optical frames
  base::Stamp last;                ///< stamp of that image
  /// Projector onto the directions of motion that the image leaves unconstrained, in the camera's frame and the tangent
  /// of geometry::Se3; zero if there are none.
  geometry::Matrix6d open = geometry::Matrix6d::Zero();
  std::optional<base::Stamp> seen_before;  ///< stamp of an old key frame whose view the image shows again
};

/// A depth camera's motion from its images as a continuous pose source (thesis 5.3.3.1, 5.3.4.2). Images are tracked in
/// the order of their stamps; an image that arrives after a later one was processed is left out. While tracking is
/// lost, as with a covered lens or a view without features, there is no motion; if the view is found again, there is a
/// motion across the gap. After a long gap tracking starts anew, and the motion in between is that of the wheels or is
/// left to other pose plugins.
///
/// If the base has wheels, their odometry predicts where a match starts, and determines directions that an image leaves
/// unconstrained, so an odometry plugin beside this one should be a fallback. If there is a gyroscope, its rotation
/// replaces that of the wheels.
class CameraOdometry : public mapper::PosePlugin {
 public:
  /// `what`: the name of the method in evidence and warnings.
  CameraOdometry(const CameraOdometryOptions& options, std::string what);

  Taken add(const mrpt::obs::CObservation::ConstPtr& observation) override;
  void processUntil(base::Stamp stamp) override;
  void share(const mrpt::obs::CObservation& observation, perception::Blackboard& board) const override;
  std::optional<mapper::RelativeMotion> between(base::Stamp begin, base::Stamp end) const override {
    return timeline_.between(begin, end);
  }
  std::optional<base::Stamp> coveredUntil() const override;
  std::vector<std::string> warnings() const override;
  /// Evidence of several kinds: gaps across which no motion was measured; the shares of images that were lost and of
  /// images that left a direction unconstrained; implausible speeds; how often, after a loss without wheels, only the
  /// view showed where the camera was; and returns to earlier views, which would reveal drift, if the method looks for
  /// such returns.
  std::vector<mapper::Evidence> evidence() const override;
  void forgetBefore(base::Stamp stamp) override { timeline_.forgetBefore(stamp); }

 private:
  /// Whether track() looks for earlier views.
  virtual bool seeksReturns() const { return true; }
  virtual ImageMotion track(const StraightImage& image, base::Stamp stamp,
                            const std::optional<motion::PredictedMotion>& prediction) = 0;
  /// Motion of the base by wheels and gyroscope; the rotation is the gyroscope's if there is one.
  struct BaseMotion {
    geometry::Se3 begin_from_end;
    geometry::Matrix6d covariance = geometry::Matrix6d::Zero();
    bool only_turn = false;  // no wheels: the translation is not known
  };
  std::optional<BaseMotion> measuredBetween(base::Stamp begin, base::Stamp end) const;
  /// Adds to the timeline a motion that images measured from `begin` to `end`.
  void addMotion(base::Stamp begin, base::Stamp end, const mapper::RelativeMotion& motion);
  void learnBias(const ImageMotion& tracked, base::Stamp stamp, const geometry::Se3& base_from_camera);
  void follow(const mrpt::obs::CObservation3DRangeScan::ConstPtr& image);
  std::optional<mapper::RelativeMotion> wheelsBetween(base::Stamp begin, base::Stamp end) const;
  bool bridgeByWheels(base::Stamp stamp);
  std::optional<motion::PredictedMotion> predictionOf(const geometry::Se3& base_from_camera, base::Stamp stamp) const;
  mapper::RelativeMotion motionOf(const ImageMotion& tracked, base::Stamp stamp, const geometry::Se3& base_from_camera,
                                  const std::optional<motion::PredictedMotion>& prediction) const;

  CameraOdometryOptions options_;
  std::string what_;
  std::optional<std::string> label_;                                           // of the first camera that came
  std::map<base::Stamp, mrpt::obs::CObservation3DRangeScan::ConstPtr> queue_;  // not yet processed
  std::optional<base::Stamp> reached_, begun_;  // stamps of the last processed and the first image
  std::optional<base::Stamp> last_;             // stamp of the last tracked image
  motion::WheelOdometry wheels_;
  motion::Gyroscope gyroscope_;
  std::optional<base::Stamp> turn_begun_;  // since then all images were tracked in all directions
  Eigen::Quaterniond turned_;              // rotation of the base since turn_begun_
  camera::LensStraightener lens_;
  std::shared_ptr<const StraightImage> newest_;  // the last processed image, if it could be read
  std::vector<base::Stamp> lost_images_;         // stamps since the last tracked image
  std::vector<Loop> loops_;
  std::size_t images_ = 0, lost_ = 0, gaps_ = 0, bridged_ = 0, hasty_in_a_row_ = 0, runaways_ = 0, found_ = 0,
              unreadable_ = 0;
  bool has_begun_ = false, is_lost_ = false;
  double first_gap_ = 0;        // [s] after the first image
  std::string why_unreadable_;  // of the first unreadable image
  motion::PoseTimeline timeline_;
};

}  // namespace omnimapper::plugins
