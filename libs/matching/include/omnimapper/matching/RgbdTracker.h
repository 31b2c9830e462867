#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/matching/DenseMatcher.h>
#include <omnimapper/matching/FeatureMatcher.h>
#include <omnimapper/motion/PredictedMotion.h>

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace omnimapper::matching {

struct RgbdTrackerOptions {
  double key_angle = 7 * base::option_text::kRadiansPerDegree;  ///< [rad] largest rotation from the key frame
  double key_distance = 0.065;         ///< largest distance from the key frame, as a share of its median depth
  double key_overlap = 0.75;           ///< smallest share of the key frame's points that are still seen
  int key_frames = 80;                 ///< largest number of key frames; the oldest are dropped
  double acceleration = 9;             ///< [m/s2] standard deviation of the camera's acceleration
  double turn_acceleration = 54;       ///< [rad/s2] standard deviation of the camera's angular acceleration
  double depth_readout = 0.02;         ///< [s] from the first row of depths to the last
  double picture_readout = 0.025;      ///< [s] from the first row of the picture to the last
  double picture_delay = 0.006;        ///< [s] from the middle of the depths to the middle of the picture
  double picture_delay_sigma = 0.001;  ///< [s] standard deviation of picture_delay; if large, delay can pass for motion
  double longest_loss = 2;             ///< [s] tracking begins anew if the camera is lost for longer
  bool use_features = true;            ///< match corners where a motion was too fast for depths and brightness

  static const base::OptionTable<RgbdTrackerOptions>& table();
};

/// Tracks a camera from image to image. Each image is registered with the nearest key frame, an earlier image whose
/// pose is known, so that drift grows with the distance travelled and not with the frame rate. Where the camera returns
/// to the view of an older key frame, that key frame is used again. A bare wall leaves directions open
/// (match.open_directions > 0). In these directions the predicted motion is kept; if wheel odometry does not measure
/// that motion, it is kept for at most `longest_loss`. Where a motion was too fast for depths and brightness, and where
/// the view was lost, corners give the initial pose of a match. The recent velocity predicts the next pose and corrects
/// the rolling shutter.
class RgbdTracker {
 public:
  RgbdTracker(const RgbdTrackerOptions& options, const DenseMatcherOptions& matching,
              const FeatureMatcherOptions& features = {});

  struct Tracked {
    enum class How {
      begun,    ///< the first image, or the first after a long loss: the motion to it is unknown
      tracked,  ///< registered
      found,    ///< registered with a key frame after it was lost
      lost,     ///< no key frame fits, or too few depths to begin: pose and motion are unknown
    };
    How how = How::begun;
    geometry::Se3 map_from_camera;           ///< optical frame; the map's frame is the camera's at the beginning
    geometry::Se3 last_from_camera;          ///< motion since the image that was tracked before
    base::Stamp last;                        ///< stamp of that image
    DenseMatch match;                        ///< with the key frame
    bool is_key_frame = false;               ///< whether the image has become a key frame
    std::optional<base::Stamp> seen_before;  ///< stamp of a much older key frame whose view the image shows
  };
  /// Tracks the next image; stamps must rise. Without a prediction, the last velocity is extrapolated. If the
  /// prediction is only a turn, this extrapolation replaces its translation.
  Tracked track(base::Stamp stamp, const RgbdPyramid& image,
                const std::optional<motion::PredictedMotion>& prediction = {});

  std::size_t keyFrames() const { return keys_.size(); }

 private:
  struct KeyFrame {
    std::shared_ptr<const DenseReference> reference;
    std::shared_ptr<const FeatureSet> features;  // none without use_features
    base::Stamp stamp;
    geometry::Se3 map_from_camera;
    double depth;  // [m] median
  };
  /// The image, with its features once they are needed.
  struct Image {
    const RgbdPyramid& pyramid;
    mutable std::shared_ptr<const FeatureSet> features = nullptr;
  };
  struct Found {
    std::size_t key;
    DenseMatch match;
  };
  /// The expected pose of the camera, and the region in which it must lie.
  struct Expected {
    geometry::Se3 map_from_camera;
    geometry::Matrix6d information = geometry::Matrix6d::Zero();
    geometry::Se3 about;             // centre of the region
    double most = 0, most_turn = 0;  // [m] [rad] radius of the region
    bool is_measured = false;        // whether wheels measured the motion
    bool is_turn_measured = false;   // whether wheels or a gyroscope measured its rotation

    bool allows(const geometry::Se3& map_from_camera) const;
  };
  Tracked begin(base::Stamp stamp, const Image& image, const geometry::Se3& map_from_camera);
  Tracked lostAt(base::Stamp last) const;
  void makeKeyFrame(base::Stamp stamp, const Image& image, const geometry::Se3& map_from_camera, double picture_delay);
  CameraMotion motion() const;
  /// Distance from the view of a key frame, scaled so that another key frame is due above 1.
  double farness(const KeyFrame& key, const geometry::Se3& map_from_camera) const;
  std::optional<std::size_t> nearest(const geometry::Se3& map_from_camera, double farthest,
                                     std::optional<std::size_t> but) const;
  DenseMatch match(std::size_t key, const Image& image, const geometry::Se3& map_from_camera,
                   const geometry::Matrix6d& information, const CameraMotion& motion) const;
  Expected expectedAfter(double seconds, const std::optional<motion::PredictedMotion>& prediction) const;
  /// The expected pose if the recent velocity goes on and fades.
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
  std::size_t current_ = 0;  // index in keys_
  // Stamps of the last tracked image, and of the last image with no open direction or with a motion that wheels
  // measured.
  std::optional<base::Stamp> last_, constrained_;
  geometry::Se3 map_from_last_;
  geometry::Vector6d velocity_ = geometry::Vector6d::Zero();  // [m/s] [rad/s] in the camera's frame
  bool is_lost_ = false;
};

}  // namespace omnimapper::matching
