#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/matching/Gyroscope.h>
#include <omnimapper/matching/PoseTimeline.h>
#include <omnimapper/matching/PredictedMotion.h>
#include <omnimapper/matching/WheelOdometry.h>
#include <omnimapper/perception/LensStraightener.h>
#include <omnimapper/perception/RgbdView.h>
#include <omnimapper/plugin/PosePlugin.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "returnEvidence.h"

namespace omnimapper::plugins {

struct CameraOdometryOptions {
  std::string label;           ///< of the camera; empty: the first that comes
  std::string odometry_label;  ///< of the wheels that predict; empty: the first that come
  std::string imu_label;       ///< of the gyroscope that predicts; empty: the first that comes
  double turn_rate_noise = matching::GyroscopeOptions{}.noise_per_root_s;  ///< [rad / sqrt(s)]
  double turn_rate_bias = matching::GyroscopeOptions{}.bias_sigma;         ///< [rad/s]
  double max_speed = 1.5;         ///< [m/s] of a camera; what seems faster is an error
  double position_noise = 0.001;  ///< [m] between two images
  double angle_noise = 0.05 * base::option_text::kRadiansPerDegree;            ///< [rad] between two images
  double position_noise_per_root_m = 0.01;                                     ///< [m / sqrt(m)]
  double position_noise_per_root_turn = 0.01;                                  ///< [m / sqrt(rad)]
  double angle_noise_per_root_m = 0.5 * base::option_text::kRadiansPerDegree;  ///< [rad / sqrt(m)]
  double angle_noise_per_root_turn = 0.013;                                    ///< [rad / sqrt(rad)]

  static const base::OptionTable<CameraOdometryOptions>& table();
};

/// What a tracker made of an image.
struct ImageMotion {
  enum class How {
    begun,
    tracked,
    found,  ///< again, after it was lost: the motion is across what nothing was known of
    lost,
  };
  How how = How::lost;
  geometry::Se3 last_from_camera;  ///< motion since the image that was tracked before, optical frames
  base::Stamp last;                ///< of that image
  /// Directions in the camera's frame that the image left open, tangent as in geometry::Se3: their projector; zero
  /// where there are none.
  geometry::Matrix6d open = geometry::Matrix6d::Zero();
  std::optional<base::Stamp> seen_before;  ///< when a key frame of long before saw what it shows again
};

/// A depth camera's motion from its images as a continuous pose source (thesis 5.3.3.1, 5.3.4.2): they are tracked in
/// the order of their stamps. One that comes after its time was worked on is left out. A lens that is covered, a view
/// that shows nothing: then the motion is not told until the view is found again, and it is told across the gap; after
/// a long gap the camera begins anew, and what happened meanwhile is told by the wheels or left to others.
///
/// Where the base has wheels, their odometry says where a match begins, and counts where an image leaves a direction
/// open: beside this it should be a fallback. Where it has a gyroscope, this tells the turning in their place.
class CameraOdometry : public mapper::PosePlugin {
 public:
  /// `what`: the name of the method, as evidence and warnings say it.
  CameraOdometry(const CameraOdometryOptions& options, std::string what);

  Taken add(const mrpt::obs::CObservation::ConstPtr& observation) override;
  void processUntil(base::Stamp stamp) override;
  std::optional<mapper::RelativeMotion> between(base::Stamp begin, base::Stamp end) const override {
    return timeline_.between(begin, end);
  }
  std::optional<base::Stamp> coveredUntil() const override;
  std::vector<std::string> warnings() const override;
  /// Gaps across which the camera did not tell the motion, how much of the time it was lost or saw too little, speeds
  /// that cannot be, how often only its view told where it was after a loss without wheels, and, where the method looks
  /// for that, how often it came back to a view of before, where what drifts would be seen.
  std::vector<mapper::Evidence> evidence() const override;
  void forgetBefore(base::Stamp stamp) override { timeline_.forgetBefore(stamp); }

 private:
  /// Whether track() looks for views of before.
  virtual bool seeksReturns() const { return true; }
  virtual ImageMotion track(const perception::RgbdView& view, base::Stamp stamp,
                            const std::optional<matching::PredictedMotion>& prediction) = 0;
  /// What wheels and gyroscope measured of the base; the turn by the gyroscope where there is one.
  struct BaseMotion {
    geometry::Se3 begin_from_end;
    geometry::Matrix6d covariance = geometry::Matrix6d::Zero();
    bool only_turn = false;  // no wheels: the translation is not known
  };
  std::optional<BaseMotion> measuredBetween(base::Stamp begin, base::Stamp end) const;
  /// Adds a motion to the timeline that images measured from `begin` to `end`.
  void addMotion(base::Stamp begin, base::Stamp end, const mapper::RelativeMotion& motion);
  void learnBias(const ImageMotion& tracked, base::Stamp stamp, const geometry::Se3& base_from_camera);
  void follow(const mrpt::obs::CObservation3DRangeScan::ConstPtr& image);
  std::optional<mapper::RelativeMotion> wheelsBetween(base::Stamp begin, base::Stamp end) const;
  bool bridgeByWheels(base::Stamp stamp);
  std::optional<matching::PredictedMotion> predictionOf(const geometry::Se3& base_from_camera, base::Stamp stamp) const;
  mapper::RelativeMotion motionOf(const ImageMotion& tracked, base::Stamp stamp, const geometry::Se3& base_from_camera,
                                  const std::optional<matching::PredictedMotion>& prediction) const;

  CameraOdometryOptions options_;
  std::string what_;
  std::optional<std::string> label_;                                          // of the first that came
  std::map<base::Stamp, mrpt::obs::CObservation3DRangeScan::ConstPtr> wait_;  // for their time
  std::optional<base::Stamp> reached_, begun_;  // image that was worked on last, first image of all
  std::optional<base::Stamp> last_;             // image that was tracked last
  matching::WheelOdometry wheels_;
  matching::Gyroscope gyroscope_;
  std::optional<base::Stamp> turn_begun_;  // of images from which on each told all of its motion
  Eigen::Quaterniond turned_;              // of the base since then
  perception::LensStraightener lens_;
  std::vector<base::Stamp> lost_images_;  // since then
  std::vector<Loop> loops_;
  std::size_t images_ = 0, lost_ = 0, gaps_ = 0, bridged_ = 0, hasty_in_a_row_ = 0, runaways_ = 0, found_ = 0,
              unreadable_ = 0;
  bool has_begun_ = false, is_lost_ = false;
  double first_gap_ = 0;        // [s] after the first image
  std::string why_unreadable_;  // of the first image that was
  matching::PoseTimeline timeline_;
};

}  // namespace omnimapper::plugins
