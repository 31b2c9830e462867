#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/camera/DepthNoise.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/matching/RgbdPyramid.h>

#include <cstddef>
#include <memory>

namespace omnimapper::matching {

struct FeatureMatcherOptions {
  int max_features = 1000;   ///< largest number of corners of an image
  int min_inliers = 15;      ///< smallest number of corner pairs that must agree on one motion
  double max_ratio = 0.8;    ///< largest ratio of the distances to the nearest and second nearest descriptor
  double pixel_noise = 1;    ///< [px] standard deviation of a corner's position
  camera::DepthNoise noise;  ///< of the depth camera

  static const base::OptionTable<FeatureMatcherOptions>& table();
};

/// Result of a registration by features.
struct FeatureMatch {
  geometry::Se3 reference_from_image;  ///< optical frames
  /// Covariance of reference_from_image, in the image's frame, with the tangent of geometry::Se3.
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();
  std::size_t pairs = 0;    ///< number of corner pairs that look alike
  std::size_t inliers = 0;  ///< number of pairs that agree on the motion
  bool succeeded = false;   ///< there are enough inliers, spread so that they determine the motion
};

/// Corners of an image with their depths and descriptors. Immutable.
class FeatureSet;

/// Registers two depth images with pictures by corners that look alike in both, however far apart the images were
/// taken: ORB features (Rublee et al.: ORB: an efficient alternative to SIFT or SURF, ICCV 2011), spread over the
/// image; mutually nearest descriptors (with Lowe's ratio); RANSAC over three pairs of points (Fischler, Bolles, CACM
/// 24(6), 1981); then least squares of the errors in column, row and inverse depth, with weights of Student's t. Const
/// functions may be called from several threads. The same input gives exactly the same result.
class FeatureMatcher {
 public:
  /// Throws Error(out_of_range) for counts or noises that are not positive.
  explicit FeatureMatcher(const FeatureMatcherOptions& options = {});

  /// The set is empty for an image without a picture.
  std::shared_ptr<const FeatureSet> prepare(const RgbdPyramid& image) const;
  FeatureMatch match(const FeatureSet& reference, const FeatureSet& image) const;

 private:
  FeatureMatcherOptions options_;
};

}  // namespace omnimapper::matching
