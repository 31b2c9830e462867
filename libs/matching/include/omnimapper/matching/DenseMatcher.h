#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/camera/DepthNoise.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/matching/RgbdPyramid.h>

#include <memory>
#include <vector>

namespace omnimapper::matching {

struct DenseMatcherOptions {
  bool use_depth = true;            ///< compare depths along the rays, with the planes of the reference
  bool use_grey = true;             ///< compare brightness, where both images have a picture
  int finest_level = 2;             ///< pyramid level at which a match ends; 0 is the full resolution
  int max_points = 3000;            ///< largest number of points of the reference on each level
  int max_iterations = 12;          ///< on each level
  camera::DepthNoise noise;         ///< of the depth camera
  double grey_noise = 3;            ///< smallest standard deviation of brightness (0 to 255)
  double min_overlap = 0.2;         ///< smallest share of the reference's points that the image must show
  double max_outlier_share = 0.35;  ///< largest share of points that may be off by more than 8 % of their depth

  static const base::OptionTable<DenseMatcherOptions>& table();
};

/// Initial pose of an image.
struct DenseGuess {
  geometry::Se3 reference_from_image;
  /// Inverse covariance of reference_from_image, in the image's frame, with the tangent of geometry::Se3. If it is
  /// zero, the pose is only where the search begins.
  geometry::Matrix6d information = geometry::Matrix6d::Zero();
};

/// Motion of a camera while it took an image, and the timing of the image's rows. Cameras such as the Kinect take the
/// picture and the depths at different times, and both row by row; at 200 deg/s, the camera turns by 2 deg in 10 ms.
struct CameraMotion {
  geometry::Vector6d velocity = geometry::Vector6d::Zero();  ///< of the camera, in its frame [m/s] [rad/s]
  double depth_readout = 0;    ///< [s] from the first row of depths to the last; the image's pose is of the middle row
  double picture_delay = 0;    ///< [s] from the middle of the depths to the middle of the picture
  double picture_readout = 0;  ///< [s] from the first row of the picture to the last
  double delay_sigma = 0;      ///< [s] standard deviation of picture_delay; 0 if it is known
};

/// Result of a match.
struct DenseMatch {
  geometry::Se3 reference_from_image;  ///< optical frames, at the middle of the depths
  double delay = 0;                    ///< [s] CameraMotion::picture_delay of the image, as estimated
  double delay_sigma = 0;              ///< [s] standard deviation of `delay`
  /// Covariance of reference_from_image, in the image's frame, from the residuals alone, without the information of the
  /// guess. A direction that the residuals do not constrain is open: its variance is kOpen, and along it the pose stays
  /// at the guess.
  geometry::Matrix6d covariance = kOpen * geometry::Matrix6d::Identity();
  double overlap = 0;        ///< share of the reference's points that the image shows, [0, 1]
  double outlier_share = 1;  ///< share of points with a depth that is far smaller or larger than predicted
  double depth_sigma = 0;    ///< standard deviation of the depth residuals, as a factor on the camera's noise
  double correlation = 0;    ///< correlation of brightness in both images, [-1, 1]; 0 without contrast
  double grey_sigma = 0;     ///< standard deviation of the brightness residuals (0 to 255)
  int open_directions = 6;   ///< number of directions that the residuals do not constrain
  bool fits = false;         ///< enough overlap, few outliers; depths or brightness agree
  bool succeeded = false;    ///< it fits and leaves no direction open

  static constexpr double kOpen = 1e4;  ///< [m2], [rad2]
};

/// Points of one image, prepared for other images to be matched against. Immutable.
class DenseReference;

/// Registers a depth image and its picture with those of a reference by projection: each point of the reference is
/// compared with the image at the pixel to which it projects, in brightness and in inverse depth along the ray. A
/// difference in depth only constrains motion along the normal of the plane on which the point lies. Gauss-Newton from
/// coarse to fine with robust weights by Student's t distribution, whose scales are estimated from the residuals (Kerl,
/// Sturm, Cremers: Robust odometry estimation for RGB-D cameras, ICRA 2013; projective association: Newcombe et al.:
/// KinectFusion, ISMAR 2011). A change of exposure is estimated as gain and offset. Const functions may be called from
/// several threads. The same input gives exactly the same result.
class DenseMatcher {
 public:
  /// Throws Error(out_of_range) for counts or noises that are not positive.
  explicit DenseMatcher(const DenseMatcherOptions& options = {});

  std::shared_ptr<const DenseReference> prepare(const RgbdPyramid& image, const CameraMotion& motion = {}) const;
  /// `motion`: that of the camera while it took `image`. If delay_sigma is above 0, the match estimates the delay, too.
  DenseMatch match(const DenseReference& reference, const RgbdPyramid& image, const DenseGuess& guess = {},
                   const CameraMotion& motion = {}) const;

 private:
  DenseMatcherOptions options_;
};

}  // namespace omnimapper::matching
