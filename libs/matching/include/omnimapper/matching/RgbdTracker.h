#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/matching/DenseMatcher.h>
#include <omnimapper/matching/FeatureMatcher.h>
#include <omnimapper/matching/PredictedMotion.h>

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace omnimapper::matching {

struct RgbdTrackerOptions {
  double key_angle = 7 * base::option_text::kRadiansPerDegree;  ///< [rad] of the camera from its key frame
  double key_distance = 0.065;                                  ///< of it, in parts of the median depth there
  double key_overlap = 0.75;                                    ///< least share of its points that are still seen
  int key_frames = 80;                                          ///< that are kept; the oldest go
  double acceleration = 9;             ///< [m/s2] standard deviation of what the motion may change by
  double turn_acceleration = 54;       ///< [rad/s2]
  double depth_readout = 0.02;         ///< [s] from the first row of depths to the last
  double picture_readout = 0.025;      ///< [s] from the first row of the picture to the last
  double picture_delay = 0.006;        ///< [s] of the picture's middle after that of the depths
  double picture_delay_sigma = 0.001;  ///< [s] with more of it a delay explains a motion that was none
  double longest_loss = 2;             ///< [s] after which a lost camera begins anew
  bool use_features = true;            ///< corners tell the motion where it was too fast for the rest

  static const base::OptionTable<RgbdTrackerOptions>& table();
};

/// Follows a camera from image to image. Each image is registered with a key frame, an earlier image whose pose is
/// known: the nearest, so that drift grows with the way and not with the frame rate. Where the camera comes back to the
/// view of an older key frame, that one is taken again. Before a bare wall, which leaves directions open, it goes on
/// there as predicted, without wheels at most for `longest_loss`, and match.open_directions tells. Where a motion was
/// too fast for depths and brightness, and where the view was lost, corners say where to look. The motion of late says
/// where to look, and tells the shutters' motion.
class RgbdTracker {
 public:
  RgbdTracker(const RgbdTrackerOptions& options, const DenseMatcherOptions& matching,
              const FeatureMatcherOptions& features = {});

  struct Tracked {
    enum class How {
      begun,    ///< the first image, or the first after a loss: nothing is known of the motion to it
      tracked,  ///< registered
      found,    ///< registered with a key frame after it was lost
      lost,     ///< no key frame fits: pose and motion are not told
    };
    How how = How::begun;
    geometry::Se3 map_from_camera;           ///< optical frame; the map's is the camera's at the beginning
    geometry::Se3 last_from_camera;          ///< motion since the image that was tracked before
    base::Stamp last;                        ///< of that image
    DenseMatch match;                        ///< with the key frame
    bool is_key_frame = false;               ///< whether it has become one
    std::optional<base::Stamp> seen_before;  ///< when a key frame of long before saw what it shows again
  };
  /// Images by rising stamps. Without a prediction, and in what it does not tell, the camera goes on as it did.
  Tracked track(base::Stamp stamp, const RgbdPyramid& image, const std::optional<PredictedMotion>& prediction = {});

  std::size_t keyFrames() const { return keys_.size(); }

 private:
  struct KeyFrame {
    std::shared_ptr<const DenseReference> reference;
    std::shared_ptr<const FeatureSet> features;  // none without use_features
    base::Stamp stamp;
    geometry::Se3 map_from_camera;
    double depth;  // [m] median
  };
  /// The image, and its features once somebody asks for them.
  struct Image {
    const RgbdPyramid& pyramid;
    mutable std::shared_ptr<const FeatureSet> features = nullptr;
  };
  struct Found {
    std::size_t key;
    DenseMatch match;
  };
  /// Where the camera should be, and where it can be.
  struct Expected {
    geometry::Se3 map_from_camera;
    geometry::Matrix6d information = geometry::Matrix6d::Zero();
    geometry::Se3 about;             // it is no farther than this from here:
    double most = 0, most_turn = 0;  // [m] [rad]
    bool is_measured = false;        // by wheels
    bool is_turn_measured = false;   // by wheels or a gyroscope

    bool allows(const geometry::Se3& map_from_camera) const;
  };
  Tracked begin(base::Stamp stamp, const Image& image, const geometry::Se3& map_from_camera);
  Tracked lostAt(base::Stamp last) const;
  void makeKeyFrame(base::Stamp stamp, const Image& image, const geometry::Se3& map_from_camera, double picture_delay);
  CameraMotion motion() const;
  /// How far off the view of a key frame is: 1 where another one is due.
  double farness(const KeyFrame& key, const geometry::Se3& map_from_camera) const;
  std::optional<std::size_t> nearest(const geometry::Se3& map_from_camera, double farthest,
                                     std::optional<std::size_t> but) const;
  DenseMatch match(std::size_t key, const Image& image, const geometry::Se3& map_from_camera,
                   const geometry::Matrix6d& information, const CameraMotion& motion) const;
  Expected expectedAfter(double seconds, const std::optional<PredictedMotion>& prediction) const;
  /// By the velocity of late, which fades.
  Expected expectedOfLate(double seconds) const;
  std::optional<Found> follow(const Image& image, const Expected& expected, double seconds) const;
  std::optional<Found> followByFeatures(const std::vector<std::size_t>& keys, const Image& image,
                                        const Expected& expected, double seconds) const;
  const std::shared_ptr<const FeatureSet>& featuresOf(const Image& image) const;
  std::vector<std::pair<std::size_t, geometry::Se3>> posesByFeatures(const Image& image) const;
  std::optional<Found> seek(const Image& image, const Expected& expected) const;
  Tracked take(base::Stamp stamp, const Image& image, Found found, const Expected& expected, Tracked::How how,
               double seconds);

  RgbdTrackerOptions options_;
  DenseMatcher matcher_;
  FeatureMatcher feature_matcher_;
  std::deque<KeyFrame> keys_;
  std::size_t current_ = 0;                 // of keys_
  std::optional<base::Stamp> last_, told_;  // image that was tracked last, and that left no direction open
  geometry::Se3 map_from_last_;
  geometry::Vector6d velocity_ = geometry::Vector6d::Zero();  // [m/s] [rad/s] in the camera's frame
  bool is_lost_ = false;
};

}  // namespace omnimapper::matching
