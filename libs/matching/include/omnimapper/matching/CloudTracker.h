#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/matching/CloudMatcher.h>
#include <omnimapper/motion/PredictedMotion.h>

#include <memory>
#include <optional>

namespace omnimapper::matching {

struct CloudTrackerOptions {
  double key_angle = 10 * base::option_text::kRadiansPerDegree;  ///< [rad] largest rotation from the key frame
  double key_distance = 0.15;                                    ///< [m] largest distance from the key frame
  double key_overlap = 0.7;  ///< smallest share of an image's points that have a point of the key frame nearby
  double longest_loss = 2;   ///< [s] tracking begins anew if the camera is lost for longer

  static const base::OptionTable<CloudTrackerOptions>& table();
};

/// Tracks a camera by the clouds of its images (thesis 5.3.3.1). Each cloud is registered with the cloud of a key frame
/// (an earlier image), so that drift grows with the distance travelled and not with the frame rate; if this fails, with
/// the cloud of the last image. In directions that the points leave open (match.open_directions > 0), the predicted
/// motion is kept. If wheel odometry does not measure that motion, it is kept for at most `longest_loss`.
class CloudTracker {
 public:
  CloudTracker(const CloudTrackerOptions& options, std::unique_ptr<const CloudMatcher> matcher);

  struct Tracked {
    enum class How {
      begun,    ///< the first image, or the first after a long loss: the motion to it is unknown
      tracked,  ///< registered
      lost,     ///< neither key frame nor last image fits, or too few points to begin: the motion is unknown
    };
    How how = How::begun;
    geometry::Se3 last_from_camera;  ///< motion since the image that was tracked before
    base::Stamp last;                ///< stamp of that image
    CloudMatch match;                ///< match with the key frame or with the last image
  };
  /// Tracks the next image; stamps must rise. Without a prediction, the last velocity is extrapolated. If the
  /// prediction is only a turn, this extrapolation replaces its translation. Directions that the image leaves open are
  /// taken from the prediction.
  Tracked track(base::Stamp stamp, std::shared_ptr<const MatchCloud> cloud,
                const std::optional<motion::PredictedMotion>& prediction = {});

 private:
  /// An image, and its pose in the frame of the key frame.
  struct Image {
    std::shared_ptr<const MatchCloud> cloud;
    geometry::Se3 key_from_camera;
    base::Stamp stamp;
    /// Stamp of the last image that left no direction open, or whose motion wheel odometry measured.
    base::Stamp constrained;
  };
  Tracked begin(base::Stamp stamp, std::shared_ptr<const MatchCloud> cloud);
  std::optional<geometry::Se3> motionTo(double seconds, const std::optional<motion::PredictedMotion>& prediction) const;
  /// Matches from the predicted pose and, if that does not fit, from the last pose.
  CloudMatch matchFrom(const MatchCloud& target, const MatchCloud& cloud, const geometry::Se3& target_from_last,
                       const std::optional<geometry::Se3>& predicted) const;
  bool isFarFromKey(const CloudMatch& match, const geometry::Se3& key_from_camera) const;

  CloudTrackerOptions options_;
  std::unique_ptr<const CloudMatcher> matcher_;
  std::shared_ptr<const MatchCloud> key_;
  std::optional<Image> last_;                                 // last tracked image
  geometry::Vector6d velocity_ = geometry::Vector6d::Zero();  // [m/s] [rad/s] in the camera's frame
};

}  // namespace omnimapper::matching
