#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/matching/RgbdPyramid.h>
#include <omnimapper/perception/DepthNoise.h>

#include <memory>
#include <vector>

namespace omnimapper::matching {

struct DenseMatcherOptions {
  bool use_depth = true;            ///< distances along the rays, from the reference's planes
  bool use_grey = true;             ///< brightness, where both have a picture
  int finest_level = 2;             ///< of the pyramids, at which a match ends; 0 is the whole image
  int max_points = 3000;            ///< of the reference, on each level
  int max_iterations = 12;          ///< on each level
  perception::DepthNoise noise;     ///< of the depth camera
  double grey_noise = 3;            ///< standard deviation of brightness, of 255, at least
  double min_overlap = 0.2;         ///< least share of the reference's points that the image shows
  double max_outlier_share = 0.35;  ///< largest share of them that are more than 8 % of their depth off

  static const base::OptionTable<DenseMatcherOptions>& table();
};

/// Where an image is thought to be.
struct DenseGuess {
  geometry::Se3 reference_from_image;
  /// Inverse covariance of that in the image's frame, tangent as in geometry::Se3; zero: it is where the search begins,
  /// and no more.
  geometry::Matrix6d information = geometry::Matrix6d::Zero();
};

/// How a camera moved while it took an image, and when it took which part. Cameras such as the Kinect take the picture
/// at another moment than the depths, and both row by row: at 200 deg/s 10 ms are 2 deg.
struct CameraMotion {
  geometry::Vector6d velocity = geometry::Vector6d::Zero();  ///< of the camera, in its frame [m/s] [rad/s]
  double depth_readout = 0;    ///< [s] from the first row of depths to the last; the image counts for the middle
  double picture_delay = 0;    ///< [s] the picture's middle after that of the depths
  double picture_readout = 0;  ///< [s] from its first row to the last
  double delay_sigma = 0;      ///< [s] of picture_delay; 0: it is known
};

/// What a match found.
struct DenseMatch {
  geometry::Se3 reference_from_image;  ///< optical frames, when the depths were taken
  double delay = 0;                    ///< [s] of the image's picture, as CameraMotion::picture_delay
  double delay_sigma = 0;              ///< [s] that is left of the guess's
  /// Of that, in the image's frame, by the residuals alone, without what the guess knew. A direction that they leave
  /// open has a variance of kOpen, and is as good as the guess.
  geometry::Matrix6d covariance = kOpen * geometry::Matrix6d::Identity();
  double overlap = 0;        ///< share of the reference's points that the image shows, [0, 1]
  double outlier_share = 1;  ///< share of those with a depth that are far nearer or farther than they should be
  double depth_sigma = 0;    ///< standard deviation of the depths' residuals, in those of the camera's noise
  double correlation = 0;    ///< of the brightness in both, [-1, 1]; 0 without contrast
  double grey_sigma = 0;     ///< standard deviation of brightness, of 255
  int open_directions = 6;   ///< how many the residuals do not fix
  bool fits = false;         ///< enough overlap, few outliers; depths or brightness are alike
  bool succeeded = false;    ///< it fits and leaves no direction open

  static constexpr double kOpen = 1e4;  ///< [m2], [rad2]
};

/// What images are matched against: points of one image, prepared. Immutable.
class DenseReference;

/// Registers a depth image and its picture with those of a reference, by projection: each point of the reference is
/// compared with what the image has at the pixel it falls on, in inverse depth along the ray, across the plane it lies
/// on, and in brightness. From coarse to fine; Gauss-Newton with weights of Student's t, whose scales are found from
/// the residuals (Kerl, Sturm, Cremers: Robust odometry estimation for RGB-D cameras, ICRA 2013; projective
/// association: Newcombe et al.: KinectFusion, ISMAR 2011). A change of exposure is taken out as gain and offset.
/// Const functions may be called from several threads. The same input gives the same bits.
class DenseMatcher {
 public:
  /// Throws Error(out_of_range) for counts or noises that are not positive.
  explicit DenseMatcher(const DenseMatcherOptions& options = {});

  std::shared_ptr<const DenseReference> prepare(const RgbdPyramid& image, const CameraMotion& motion = {}) const;
  /// `motion` is the image's; a delay that is not known is found by the match.
  DenseMatch match(const DenseReference& reference, const RgbdPyramid& image, const DenseGuess& guess = {},
                   const CameraMotion& motion = {}) const;

 private:
  DenseMatcherOptions options_;
};

}  // namespace omnimapper::matching
