#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/matching/RgbdPyramid.h>
#include <omnimapper/perception/DepthNoise.h>

#include <cstddef>
#include <memory>

namespace omnimapper::matching {

struct FeatureMatcherOptions {
  int max_features = 1000;       ///< corners of an image
  int min_inliers = 15;          ///< pairs of corners that agree on one motion
  double max_ratio = 0.8;        ///< of the distances of a descriptor to the nearest and to the second nearest
  double pixel_noise = 1;        ///< [px] standard deviation of a corner's place
  perception::DepthNoise noise;  ///< of the depth camera

  static const base::OptionTable<FeatureMatcherOptions>& table();
};

/// What a registration by features found.
struct FeatureMatch {
  geometry::Se3 reference_from_image;  ///< optical frames
  /// Of that in the image's frame, tangent as in geometry::Se3.
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();
  std::size_t pairs = 0;    ///< of corners that look alike
  std::size_t inliers = 0;  ///< of those that agree on the motion
  bool succeeded = false;   ///< enough of them, and spread so that they fix the motion
};

/// Corners of an image with their depths and descriptors. Immutable.
class FeatureSet;

/// Registers two depth images with pictures by corners that look alike in both, from however far apart they were taken:
/// ORB features (Rublee et al.: ORB: an efficient alternative to SIFT or SURF, ICCV 2011), spread over the image;
/// nearest descriptors that are each other's (Lowe's ratio); RANSAC over three pairs of points (Fischler, Bolles, CACM
/// 24(6), 1981); then the motion that makes the errors in column, row and inverse depth small, with weights of
/// Student's t. Const functions may be called from several threads. The same input gives the same bits.
class FeatureMatcher {
 public:
  /// Throws Error(out_of_range) for counts or noises that are not positive.
  explicit FeatureMatcher(const FeatureMatcherOptions& options = {});

  /// Of an image without a picture the set is empty.
  std::shared_ptr<const FeatureSet> prepare(const RgbdPyramid& image) const;
  FeatureMatch match(const FeatureSet& reference, const FeatureSet& image) const;

 private:
  FeatureMatcherOptions options_;
};

}  // namespace omnimapper::matching
