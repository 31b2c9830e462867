#include <omnimapper/base/Error.h>
#include <omnimapper/base/SplitMix.h>
#include <omnimapper/geometry/SymmetricEigen.h>
#include <omnimapper/matching/FeatureMatcher.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "image/FeatureSet.h"

namespace omnimapper::matching {

using geometry::Matrix6d;
using geometry::Se3;
using geometry::Vector6d;

namespace {

using Corner = FeatureSet::Corner;
using Descriptor = FeatureSet::Descriptor;
using CornerJacobian = Eigen::Matrix<double, 3, 6>;

int bitsBetween(const Descriptor& a, const Descriptor& b) {
  int bits = 0;
  for (std::size_t i = 0; i < a.size(); ++i) bits += __builtin_popcountll(a[i] ^ b[i]);
  return bits;
}

struct NearestCorner {
  int index = -1, best = 257, second = 257;

  void see(int other, int bits) {
    if (bits < best) {
      second = best;
      best = bits;
      index = other;
    } else if (bits < second) {
      second = bits;
    }
  }
  bool isDistinct(double max_ratio) const {
    constexpr int kAlike = 64;  // bits of 256
    return index >= 0 && best <= kAlike && best < max_ratio * second;
  }
};

struct CornerPair {
  const Corner *reference, *image;
};

std::vector<CornerPair> alikeCorners(const FeatureSet& reference, const FeatureSet& image, double max_ratio) {
  std::vector<NearestCorner> of_reference(reference.corners.size()), of_image(image.corners.size());
  for (std::size_t i = 0; i < image.corners.size(); ++i) {
    for (std::size_t r = 0; r < reference.corners.size(); ++r) {
      const int bits = bitsBetween(reference.descriptors[r], image.descriptors[i]);
      of_image[i].see(static_cast<int>(r), bits);
      of_reference[r].see(static_cast<int>(i), bits);
    }
  }
  std::vector<CornerPair> pairs;
  for (std::size_t i = 0; i < image.corners.size(); ++i) {
    if (!of_image[i].isDistinct(max_ratio)) continue;
    const auto r = static_cast<std::size_t>(of_image[i].index);
    if (of_reference[r].index == static_cast<int>(i)) pairs.push_back({&reference.corners[r], &image.corners[i]});
  }
  return pairs;
}

/// Errors of pairs of corners, in standard deviations.
class CornerErrors {
 public:
  CornerErrors(const camera::Pinhole& camera, const FeatureMatcherOptions& options)
      : camera_(camera),
        pixel_(std::sqrt(2.0) * options.pixel_noise),
        depth_(std::sqrt(2 * options.noise.pixelVariance())) {}

  Eigen::Vector3d of(const CornerPair& pair, const Se3& reference_from_image,
                     CornerJacobian* by_motion = nullptr) const {
    const Eigen::Vector3d q = reference_from_image * pair.image->point;
    constexpr double kNearest = 0.05;  // [m]
    if (q.z() < kNearest) return Eigen::Vector3d::Constant(1e3);
    const double inverse = 1 / q.z();
    const Eigen::Vector3d scale =
        Eigen::Vector3d(1 / pixel_, 1 / pixel_, 1 / depth_) / std::max(pair.reference->scale, pair.image->scale);
    const Eigen::Vector3d predicted(camera_.fx * q.x() * inverse + camera_.cx,
                                    camera_.fy * q.y() * inverse + camera_.cy, inverse);
    if (by_motion != nullptr) {
      Eigen::Matrix3d by_point;
      by_point << camera_.fx * inverse, 0, -camera_.fx * q.x() * inverse * inverse, 0, camera_.fy * inverse,
          -camera_.fy * q.y() * inverse * inverse, 0, 0, -inverse * inverse;
      const Eigen::Matrix3d rotation = reference_from_image.rotation.toRotationMatrix();
      Eigen::Matrix3d cross;
      const auto& p = pair.image->point;
      cross << 0, -p.z(), p.y(), p.z(), 0, -p.x(), -p.y(), p.x(), 0;
      by_motion->leftCols<3>() = scale.asDiagonal() * by_point * rotation;
      by_motion->rightCols<3>() = -(scale.asDiagonal() * by_point * rotation * cross);
    }
    return scale.cwiseProduct(predicted - pair.reference->seen);
  }

 private:
  camera::Pinhole camera_;
  double pixel_, depth_;  // [px] [1/m] of a difference
};

constexpr double kCornerGate = 16.27;  // chi-square of three degrees of freedom, 99.9 %

// The rigid motion of three pairs of points, by least squares (Umeyama).
Se3 motionOf(const std::array<CornerPair, 3>& three) {
  Eigen::Matrix3d to, from;
  for (int i = 0; i < 3; ++i) {
    to.col(i) = three[static_cast<std::size_t>(i)].reference->point;
    from.col(i) = three[static_cast<std::size_t>(i)].image->point;
  }
  const Eigen::Matrix4d found = Eigen::umeyama(from, to, false);
  return {Eigen::Quaterniond(Eigen::Matrix3d(found.topLeftCorner<3, 3>())).normalized(), found.topRightCorner<3, 1>()};
}

// Whether the three points have the same distances in both images, large enough to determine a rotation.
bool areAlike(const std::array<CornerPair, 3>& three) {
  constexpr double kApart = 0.1, kStretch = 0.1;  // [m] [-]
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &a = three[i], &b = three[(i + 1) % 3];
    const double there = (a.reference->point - b.reference->point).norm();
    const double here = (a.image->point - b.image->point).norm();
    if (there < kApart || std::abs(there - here) > kStretch * std::max(there, here)) return false;
  }
  return true;
}

std::vector<CornerPair> inliersOf(const std::vector<CornerPair>& pairs, const CornerErrors& errors, const Se3& motion) {
  std::vector<CornerPair> inliers;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(inliers),
               [&](const CornerPair& pair) { return errors.of(pair, motion).squaredNorm() < kCornerGate; });
  return inliers;
}

// RANSAC: of the motions of many random sets of three pairs, the one that most pairs agree with.
std::optional<Se3> agreedMotion(const std::vector<CornerPair>& pairs, const CornerErrors& errors) {
  constexpr int kDraws = 1500, kMotions = 300;
  base::SplitMix random(pairs.size());
  std::optional<Se3> best;
  std::size_t most = 0;
  for (int draw = 0, motions = 0; draw < kDraws && motions < kMotions; ++draw) {
    std::array<CornerPair, 3> three;
    for (auto& one : three) one = pairs[static_cast<std::size_t>(random.below(static_cast<int>(pairs.size())))];
    if (!areAlike(three)) continue;
    ++motions;
    const Se3 motion = motionOf(three);
    const auto agree = static_cast<std::size_t>(std::count_if(pairs.begin(), pairs.end(), [&](const CornerPair& pair) {
      return errors.of(pair, motion).squaredNorm() < kCornerGate;
    }));
    if (agree <= most) continue;
    most = agree;
    best = motion;
    // If more than half of the pairs agree, further draws are not needed.
    if (2 * most > pairs.size() && motions > kMotions / 10) break;
  }
  return best;
}

// Gauss-Newton with weights of Student's t; the information is that of the last step.
Matrix6d refineByCorners(const std::vector<CornerPair>& pairs, const CornerErrors& errors, Se3& motion) {
  constexpr double kFreedom = 5;
  constexpr int kSteps = 8;
  Matrix6d information = Matrix6d::Zero();
  for (int step = 0; step < kSteps; ++step) {
    information.setZero();
    Vector6d gradient = Vector6d::Zero();
    for (const auto& pair : pairs) {
      CornerJacobian by_motion;
      const Eigen::Vector3d error = errors.of(pair, motion, &by_motion);
      const double weight = (kFreedom + 3) / (kFreedom + error.squaredNorm());
      information += weight * by_motion.transpose() * by_motion;
      gradient += weight * by_motion.transpose() * error;
    }
    constexpr double kDamping = 1e-9;
    const Vector6d delta = -(information + kDamping * Matrix6d::Identity()).ldlt().solve(gradient);
    motion = plus(motion, delta);
    constexpr double kStill = 1e-6;  // [m] [rad]
    if (delta.norm() < kStill) break;
  }
  return information;
}

}  // namespace

const base::OptionTable<FeatureMatcherOptions>& FeatureMatcherOptions::table() {
  using Options = FeatureMatcherOptions;
  static const auto table =
      base::OptionTable<Options>()
          .integer("max_features", &Options::max_features, base::Range{10, 20000},
                   "Largest number of corners that are extracted from a picture.")
          .integer("min_feature_inliers", &Options::min_inliers, base::Range{6, 10000},
                   "A motion is accepted only if at least this many pairs of corresponding corners agree with it.")
          .number("max_feature_ratio", &Options::max_ratio, base::Range{0.1, 1},
                  "A corner corresponds to the most similar corner of another image only if the two differ by at most "
                  "this share of the difference from the second most similar corner.");
  return table;
}

FeatureMatcher::FeatureMatcher(const FeatureMatcherOptions& options) : options_(options) {
  if (options.max_features <= 0 || options.min_inliers <= 0 || !(options.pixel_noise > 0) || !(options.noise.sigma > 0))
    throw base::Error(base::ExitCode::out_of_range, "matching of features: counts and noises must be positive");
}

std::shared_ptr<const FeatureSet> FeatureMatcher::prepare(const RgbdPyramid& image) const {
  return std::make_shared<const FeatureSet>(image, options_.max_features);
}

FeatureMatch FeatureMatcher::match(const FeatureSet& reference, const FeatureSet& image) const {
  FeatureMatch match;
  const auto pairs = alikeCorners(reference, image, options_.max_ratio);
  match.pairs = pairs.size();
  const auto fewest = static_cast<std::size_t>(options_.min_inliers);
  if (pairs.size() < fewest) return match;
  const CornerErrors errors(reference.camera, options_);
  auto motion = agreedMotion(pairs, errors);
  if (!motion) return match;
  Matrix6d information = Matrix6d::Zero();
  for (int round = 0; round < 3; ++round) {
    const auto inliers = inliersOf(pairs, errors, *motion);
    match.inliers = inliers.size();
    if (inliers.size() < fewest) return match;
    information = refineByCorners(inliers, errors, *motion);
  }
  match.reference_from_image = *motion;
  const Vector6d strengths = geometry::eigenvaluesOf<6>(information);
  constexpr double kWeakest = 1e3;  // [1/m2] [1/rad2]
  match.succeeded = strengths[0] > kWeakest;
  if (match.succeeded) match.covariance = information.inverse();
  return match;
}

}  // namespace omnimapper::matching
