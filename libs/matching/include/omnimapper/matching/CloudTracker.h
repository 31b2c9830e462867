#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/matching/CloudMatcher.h>
#include <omnimapper/matching/PredictedMotion.h>

#include <memory>
#include <optional>

namespace omnimapper::matching {

struct CloudTrackerOptions {
  double key_angle = 10 * base::option_text::kRadiansPerDegree;  ///< [rad] of the camera from its key frame
  double key_distance = 0.15;                                    ///< [m] of it
  double key_overlap = 0.7;  ///< least share of an image's points that have one of the key frame's near
  double longest_loss = 2;   ///< [s] after which a lost camera begins anew

  static const base::OptionTable<CloudTrackerOptions>& table();
};

/// Follows a camera by clouds of its images (thesis 5.3.3.1): each is registered with that of a key frame, so that
/// drift grows with the way and not with the frame rate, and where this fails with the last image's. Where the points
/// leave directions open, it goes on there as it did, at most for `longest_loss`, and match.open_directions tells.
class CloudTracker {
 public:
  CloudTracker(const CloudTrackerOptions& options, std::unique_ptr<const CloudMatcher> matcher);

  struct Tracked {
    enum class How {
      begun,    ///< the first image, or the first after a long loss: nothing is known of the motion to it
      tracked,  ///< registered
      lost,     ///< neither key frame nor last image fits: the motion is not told
    };
    How how = How::begun;
    geometry::Se3 last_from_camera;  ///< motion since the image that was tracked before
    base::Stamp last;                ///< of that image
    CloudMatch match;                ///< with the key frame, or the last image
  };
  /// Images by rising stamps. Without a prediction, and in what it does not tell, the camera goes on as it did. Where
  /// the image leaves a direction open the prediction is taken.
  Tracked track(base::Stamp stamp, std::shared_ptr<const MatchCloud> cloud,
                const std::optional<PredictedMotion>& prediction = {});

 private:
  /// An image, and its pose in the frame of the key frame.
  struct Image {
    std::shared_ptr<const MatchCloud> cloud;
    geometry::Se3 key_from_camera;
    base::Stamp stamp;
    base::Stamp told;  ///< of the last image that left no direction open
  };
  Tracked begin(base::Stamp stamp, std::shared_ptr<const MatchCloud> cloud);
  std::optional<geometry::Se3> motionTo(double seconds, const std::optional<PredictedMotion>& prediction) const;
  /// From where it is predicted, and if that does not fit, from where it was.
  CloudMatch matchFrom(const MatchCloud& target, const MatchCloud& cloud, const geometry::Se3& target_from_last,
                       const std::optional<geometry::Se3>& predicted) const;
  bool isFarFromKey(const CloudMatch& match, const geometry::Se3& key_from_camera) const;

  CloudTrackerOptions options_;
  std::unique_ptr<const CloudMatcher> matcher_;
  std::shared_ptr<const MatchCloud> key_;
  std::optional<Image> last_;                                 // that was tracked
  geometry::Vector6d velocity_ = geometry::Vector6d::Zero();  // [m/s] [rad/s] in the camera's frame
};

}  // namespace omnimapper::matching
