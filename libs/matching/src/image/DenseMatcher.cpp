#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/SymmetricEigen.h>
#include <omnimapper/matching/DenseMatcher.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "image/DenseReference.h"
#include "image/Shutter.h"

namespace omnimapper::matching {

namespace {

using geometry::Matrix6d;
using geometry::Se3;
using geometry::Vector6d;

constexpr float kFreedom = 5;  // degrees of freedom of Student's t
// A point that is nearer or farther by more than this share of its depth is hidden, or not there any more.
constexpr float kRelativeOutlier = 0.08F;
// Largest relative difference of inverse depths between neighbours on one surface, between which the image is
// interpolated.
constexpr float kGap = 0.05F;

/// Sums of J^T w J and J^T w r over one kind of residuals, in their standard deviations.
struct DenseSums {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double weighted_squares = 0, count = 0;
};

/// The same in lanes, the upper triangle row by row.
struct LaneSums {
  std::array<Lanes, 21> information;
  std::array<Lanes, 6> gradient;
  Lanes weighted_squares = Lanes::Zero(), count = Lanes::Zero();

  LaneSums() {
    for (auto& lanes : information) lanes.setZero();
    for (auto& lanes : gradient) lanes.setZero();
  }

  void add(const std::array<Lanes, 6>& jacobian, const Lanes& residual, const Lanes& weight, const Lanes& is_counted) {
    std::size_t at = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      const Lanes weighted = weight * jacobian[i];
      gradient[i] += weighted * residual;
      for (std::size_t j = i; j < 6; ++j) information[at++] += weighted * jacobian[j];
    }
    weighted_squares += weight * residual * residual;
    count += is_counted;
  }

  DenseSums total() const {
    DenseSums sums;
    std::size_t at = 0;
    for (int i = 0; i < 6; ++i) {
      sums.gradient[i] = gradient[static_cast<std::size_t>(i)].cast<double>().sum();
      for (int j = i; j < 6; ++j)
        sums.information(i, j) = sums.information(j, i) = information[at++].cast<double>().sum();
    }
    sums.weighted_squares = weighted_squares.cast<double>().sum();
    sums.count = count.cast<double>().sum();
    return sums;
  }
};

/// Brightness in the image is that in the reference times gain plus offset.
struct Exposure {
  float gain = 1, offset = 0;
};

/// Weighted sums from which gain and offset are estimated.
struct ExposureSums {
  Lanes weight = Lanes::Zero(), reference = Lanes::Zero(), image = Lanes::Zero(), squares = Lanes::Zero(),
        image_squares = Lanes::Zero(), products = Lanes::Zero();

  // Correlation of the brightness in both; 0 where there is no contrast.
  double correlation() const {
    const double n = weight.cast<double>().sum();
    if (n <= 0) return 0;
    const double r = reference.cast<double>().sum() / n, i = image.cast<double>().sum() / n;
    const double of_reference = squares.cast<double>().sum() / n - r * r;
    const double of_image = image_squares.cast<double>().sum() / n - i * i;
    const double product = products.cast<double>().sum() / n - r * i;
    constexpr double kLeast = 0.25;  // more than rounding leaves
    return of_reference > kLeast && of_image > kLeast ? product / std::sqrt(of_reference * of_image) : 0;
  }

  Exposure solved(const Exposure& before) const {
    const double n = weight.cast<double>().sum();
    if (n < 50) return before;
    const double r = reference.cast<double>().sum() / n, i = image.cast<double>().sum() / n;
    const double variance = squares.cast<double>().sum() / n - r * r,
                 product = products.cast<double>().sum() / n - r * i;
    constexpr double kLeastVariance = 25, kMostGain = 1.5;  // a bare wall does not determine the gain
    const double gain = variance > kLeastVariance ? std::clamp(product / variance, 1 / kMostGain, kMostGain) : 1;
    return {static_cast<float>(gain), static_cast<float>(i - gain * r)};
  }
};

struct Scales {
  float depth, grey;  // [1/m], of 255
};

/// Comparison on one level: how the reference's points, projected from a pose, differ from the image.
struct Evaluation {
  DenseSums depth, grey;
  Exposure exposure;
  double shown = 0, outliers = 0, measured = 0;  // points that the image shows, that are outliers, that have a depth
  double correlation = 0;                        // of brightness
};

// Interpolated between four pixels; 0 where they are not of one surface, or one is not known.
float inverseDepthAt(const RgbdLevel& level, float u, float v) {
  const int x = static_cast<int>(u), y = static_cast<int>(v);
  const float right = u - static_cast<float>(x), down = v - static_cast<float>(y);
  const auto width = static_cast<std::size_t>(level.width);
  const float* w = level.inverse_depth.data() + level.at(x, y);
  const float a = w[0], b = w[1], c = w[width], d = w[width + 1];
  const float least = std::min(std::min(a, b), std::min(c, d)), most = std::max(std::max(a, b), std::max(c, d));
  if (!(least > 0) || most - least > kGap * most) return 0;
  return (1 - down) * ((1 - right) * a + right * b) + down * ((1 - right) * c + right * d);
}

float greyAt(const RgbdLevel& level, float u, float v) {
  const int x = static_cast<int>(u), y = static_cast<int>(v);
  const float right = u - static_cast<float>(x), down = v - static_cast<float>(y);
  const auto width = static_cast<std::size_t>(level.width);
  const float* g = level.grey.data() + level.at(x, y);
  return (1 - down) * ((1 - right) * g[0] + right * g[1]) + down * ((1 - right) * g[width] + right * g[width + 1]);
}

/// Points of the reference in the image's frame, at the time of the rows that show them, and their pixels there.
struct Projection {
  Projection(const Lanes& in_x, const Lanes& in_y, const Lanes& in_z, const RgbdLevel& level, const Shutter& shutter)
      : x(in_x), y(in_y), z(in_z) {
    const auto fx = static_cast<float>(level.camera.fx), fy = static_cast<float>(level.camera.fy);
    const auto cx = static_cast<float>(level.camera.cx), cy = static_cast<float>(level.camera.cy);
    if (shutter.delay() != 0 || shutter.readout() != 0) {
      const Lanes row = (fy * y / z.max(kNearest) + cy).max(0).min(static_cast<float>(level.height));
      const auto per_row = static_cast<float>(shutter.readout() / level.height);
      const Lanes after = static_cast<float>(shutter.after(0, level.height)) + per_row * row;
      const Eigen::Vector3f v = shutter.linear().cast<float>(), w = shutter.turn().cast<float>();
      x = in_x - after * (v.x() + w.y() * in_z - w.z() * in_y);
      y = in_y - after * (v.y() + w.z() * in_x - w.x() * in_z);
      z = in_z - after * (v.z() + w.x() * in_y - w.y() * in_x);
    }
    inverse = 1 / z.max(kNearest);
    u = fx * x * inverse + cx;
    this->v = fy * y * inverse + cy;
  }

  bool isShown(Eigen::Index i, const RgbdLevel& level) const {
    return z[i] > kNearest && u[i] >= 0 && u[i] < static_cast<float>(level.width - 1) && v[i] >= 0 &&
           v[i] < static_cast<float>(level.height - 1);
  }

  static constexpr float kNearest = 0.05F;  // [m]
  Lanes x, y, z, inverse, u, v;
};

Lanes where(const Eigen::Array<bool, kLanes, 1>& condition) {
  return condition.select(Lanes::Ones(), Lanes::Zero());
}

/// One level of an image, with all that the reference's points are compared by.
struct ImageView {
  const RgbdLevel& level;
  Se3 image_from_reference;
  Shutter depth_shutter, picture_shutter;
  Scales scales;
  Exposure exposure;
  bool use_depth, use_grey;
};

Evaluation evaluate(const DenseReferenceLevel& reference, const ImageView& view) {
  const Eigen::Matrix3f rotation = view.image_from_reference.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f translation = view.image_from_reference.translation.cast<float>();
  const Eigen::Vector3f back = rotation.transpose() * translation;
  LaneSums depth_sums, grey_sums;
  ExposureSums exposure_sums;
  Lanes shown = Lanes::Zero(), outliers = Lanes::Zero(), depths = Lanes::Zero();
  const float one_over_depth = 1 / view.scales.depth, one_over_grey = 1 / view.scales.grey;
  const auto weightOf = [](const Lanes& residual, const Lanes& is_used) -> Lanes {
    return is_used * ((kFreedom + 1) / (kFreedom + residual.square()));
  };
  for (const auto& p : reference.points) {
    const Lanes x = rotation(0, 0) * p.x + rotation(0, 1) * p.y + rotation(0, 2) * p.z + translation.x();
    const Lanes y = rotation(1, 0) * p.x + rotation(1, 1) * p.y + rotation(1, 2) * p.z + translation.y();
    const Lanes z = rotation(2, 0) * p.x + rotation(2, 1) * p.y + rotation(2, 2) * p.z + translation.z();
    const Projection seen(x, y, z, view.level, view.depth_shutter);
    Lanes measured = Lanes::Zero(), is_shown = Lanes::Zero();
    for (Eigen::Index i = 0; i < kLanes; ++i) {
      if (p.is_point[i] == 0 || !seen.isShown(i, view.level)) continue;
      is_shown[i] = 1;
      measured[i] = inverseDepthAt(view.level, seen.u[i], seen.v[i]);
    }
    shown += is_shown;
    const Lanes has_depth = where(measured > 0);
    depths += has_depth;
    const Lanes difference = has_depth * (measured - seen.inverse);
    const Lanes is_outlier = where(difference.abs() > kRelativeOutlier * seen.inverse);
    outliers += is_outlier;
    const Lanes is_fair = (1 - is_outlier) * is_shown;
    if (view.use_depth) {
      // n . q of the rotated normal, as n . (p + R^T t); negative, because the normal is towards the camera.
      const Lanes across = p.nx * (p.x + back.x()) + p.ny * (p.y + back.y()) + p.nz * (p.z + back.z());
      constexpr float kGrazing = 0.1F;  // cosine of the angle between ray and normal
      const Lanes range = (seen.x.square() + seen.y.square() + seen.z.square()).sqrt();
      const Lanes is_used = where(across < -kGrazing * range) * is_fair * has_depth;
      const Lanes factor = one_over_depth * seen.inverse / (is_used > 0).select(across, -Lanes::Ones());
      const Lanes residual = one_over_depth * difference;
      depth_sums.add({factor * p.nx, factor * p.ny, factor * p.nz, factor * (p.y * p.nz - p.z * p.ny),
                      factor * (p.z * p.nx - p.x * p.nz), factor * (p.x * p.ny - p.y * p.nx)},
                     residual, weightOf(residual, is_used), is_used);
    }
    if (view.use_grey) {
      const Projection pictured(x, y, z, view.level, view.picture_shutter);
      Lanes grey = Lanes::Zero(), is_used = Lanes::Zero();
      for (Eigen::Index i = 0; i < kLanes; ++i) {
        if (is_fair[i] == 0 || p.grey[i] < 0 || !pictured.isShown(i, view.level)) continue;
        is_used[i] = 1;
        grey[i] = greyAt(view.level, pictured.u[i], pictured.v[i]);
      }
      const Lanes residual = one_over_grey * is_used * (grey - view.exposure.gain * p.grey - view.exposure.offset);
      const Lanes weight = weightOf(residual, is_used);
      const float scale = one_over_grey * view.exposure.gain;
      grey_sums.add({scale * p.gx, scale * p.gy, scale * p.gz, scale * (p.y * p.gz - p.z * p.gy),
                     scale * (p.z * p.gx - p.x * p.gz), scale * (p.x * p.gy - p.y * p.gx)},
                    residual, weight, is_used);
      exposure_sums.weight += weight;
      exposure_sums.reference += weight * p.grey;
      exposure_sums.image += weight * grey;
      exposure_sums.squares += weight * p.grey * p.grey;
      exposure_sums.image_squares += weight * grey * grey;
      exposure_sums.products += weight * p.grey * grey;
    }
  }
  return {depth_sums.total(),
          grey_sums.total(),
          view.use_grey ? exposure_sums.solved(view.exposure) : view.exposure,
          shown.cast<double>().sum(),
          outliers.cast<double>().sum(),
          depths.cast<double>().sum(),
          exposure_sums.correlation()};
}

// Removes from the depths' information the directions that the planes leave open.
void withoutOpen(const DenseReferenceLevel& reference, Evaluation& evaluation) {
  if (reference.open.cols() == 0) return;
  const Matrix6d kept = Matrix6d::Identity() - reference.open * reference.open.transpose();
  evaluation.depth.information = kept * evaluation.depth.information * kept;
  evaluation.depth.gradient = kept * evaluation.depth.gradient;
}

// Scale of the residuals, estimated from sums that were weighted with the scale `before`.
float scaleOf(const DenseSums& sums, float before, float least) {
  if (sums.count < 20) return before;
  return std::max(least, before * static_cast<float>(std::sqrt(sums.weighted_squares / sums.count)));
}

}  // namespace

const base::OptionTable<DenseMatcherOptions>& DenseMatcherOptions::table() {
  using Options = DenseMatcherOptions;
  static const auto table =
      base::OptionTable<Options>()
          .flag("use_depth", &Options::use_depth, "Matches images by their depths.")
          .flag("use_brightness", &Options::use_grey, "Matches images by the brightness of their pictures.")
          .integer("finest_level", &Options::finest_level, base::Range{0, 3},
                   "Images are matched at several resolutions, from coarse to fine. Number of times that the images "
                   "are halved at the finest resolution; 0 for the full resolution.")
          .integer("max_points", &Options::max_points, base::Range{50, 400000},
                   "Largest number of points of a reference image at each resolution at which images are matched.")
          .integer("max_iterations", &Options::max_iterations, base::Range{1, 1000},
                   "Largest number of iterations of a match at each resolution at which images are matched.")
          .number(
              "brightness_noise", &Options::grey_noise, base::Range::positive(),
              "Smallest standard deviation that is assumed for the brightness of a pixel, on a scale from 0 to 255.")
          .number("min_overlap", &Options::min_overlap, base::Range{0, 1},
                  "A match is accepted only if the image shows at least this share of the reference image's points.")
          .number("max_outlier_share", &Options::max_outlier_share, base::Range{0, 1},
                  "A match is accepted only if at most this share of the reference image's visible points have a depth "
                  "that clearly differs from the expected one.");
  return table;
}

DenseMatcher::DenseMatcher(const DenseMatcherOptions& options) : options_(options) {
  const bool are_counts = options.max_points > 0 && options.max_iterations > 0 && options.finest_level >= 0;
  if (!are_counts || !(options.noise.sigma > 0) || !(options.grey_noise > 0))
    throw base::Error(base::ExitCode::out_of_range, "dense matching: counts and noises must be positive");
}

namespace {

using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;

/// Pose and delay of the picture, which are improved step by step.
class PoseSearch {
 public:
  Se3 image_from_reference;
  double delay;                             ///< [s]
  Matrix7d information = Matrix7d::Zero();  ///< of the residuals and of the prior of the delay

  PoseSearch(const DenseGuess& guess, const CameraMotion& motion)
      : image_from_reference(inverse(guess.reference_from_image)),
        delay(motion.picture_delay),
        guess_(guess),
        motion_(motion) {}

  /// Makes one step and returns its length: [m] and [rad], the greater.
  double step(const DenseSums& depth, const DenseSums& grey) {
    const Matrix6d ad = adjoint(image_from_reference);
    // A change of the delay displaces all points in the picture as a motion of the camera would.
    const Vector6d by_delay = -adjoint(inverse(image_from_reference)) * motion_.velocity;
    information.setZero();
    information.topLeftCorner<6, 6>() = depth.information + grey.information;
    information.block<6, 1>(0, 6) = grey.information * by_delay;
    information.block<1, 6>(6, 0) = information.block<6, 1>(0, 6).transpose();
    information(6, 6) = by_delay.dot(grey.information * by_delay);
    Vector7d gradient;
    gradient << depth.gradient + grey.gradient, by_delay.dot(grey.gradient);
    addDelay(gradient);
    Matrix7d known = information;
    if (!guess_.information.isZero(0)) {
      // In the reference's frame, where the step is taken. Neighbouring residuals have similar errors, so kDependence
      // of them count as one.
      constexpr double kDependence = 25;
      const Vector6d off = minus(inverse(image_from_reference), guess_.reference_from_image);
      known.topLeftCorner<6, 6>() += kDependence * ad.transpose() * guess_.information * ad;
      gradient.head<6>() -= kDependence * ad.transpose() * guess_.information * off;
    }
    constexpr double kDamping = 1e-6;
    known.diagonal() += kDamping * known.diagonal() + Vector7d::Constant(1e-6);
    const Vector7d delta = -known.ldlt().solve(gradient);
    image_from_reference = plus(image_from_reference, delta.head<6>());
    delay += delta[6];
    return std::max(delta.head<3>().norm(), delta.segment<3>(3).norm());
  }

 private:
  void addDelay(Vector7d& gradient) {
    constexpr double kKnown = 1e-6;  // [s]
    const double sigma = std::max(motion_.delay_sigma, kKnown);
    information(6, 6) += 1 / (sigma * sigma);
    gradient[6] += (delay - motion_.picture_delay) / (sigma * sigma);
  }

  const DenseGuess& guess_;
  const CameraMotion& motion_;
};

}  // namespace

DenseMatch DenseMatcher::match(const DenseReference& reference, const RgbdPyramid& image, const DenseGuess& guess,
                               const CameraMotion& motion) const {
  const auto& levels = image.levels();
  const bool use_grey = options_.use_grey && reference.has_picture && image.hasPicture();
  const auto least_depth = static_cast<float>(std::sqrt(options_.noise.pixelVariance()) / 2);
  const auto least_grey = static_cast<float>(options_.grey_noise);
  Scales scales{4 * least_depth, 5 * least_grey};
  Exposure exposure;
  PoseSearch search(guess, motion);
  Evaluation last;
  std::size_t points = 0;
  for (std::size_t l = std::min(levels.size(), reference.levels.size()); l-- > 0;) {
    if (reference.levels[l].points.empty()) continue;
    points = reference.levels[l].count;
    for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
      last = evaluate(
          reference.levels[l],
          {levels[l], search.image_from_reference, Shutter(motion, 0, motion.depth_readout),
           Shutter(motion, search.delay, motion.picture_readout), scales, exposure, options_.use_depth, use_grey});
      scales = {scaleOf(last.depth, scales.depth, least_depth), scaleOf(last.grey, scales.grey, least_grey)};
      exposure = last.exposure;
      withoutOpen(reference.levels[l], last);
      constexpr double kStill = 2e-5;  // [m], [rad]
      if (search.step(last.depth, last.grey) < kStill * static_cast<double>(1 << l)) break;
    }
  }
  DenseMatch match;
  match.correlation = last.correlation;
  match.delay = search.delay;
  match.delay_sigma = motion.delay_sigma;
  match.reference_from_image = inverse(search.image_from_reference);
  if (points == 0) return match;
  match.overlap = last.shown / static_cast<double>(points);
  match.outlier_share = last.measured > 0 ? last.outliers / last.measured : 0;
  match.depth_sigma = scales.depth / std::sqrt(options_.noise.pixelVariance());
  match.grey_sigma = use_grey ? scales.grey : 0;
  // The information of the pose after the delay is estimated from the same residuals.
  const Vector6d with_delay = search.information.block<6, 1>(0, 6);
  // Brightness that does not correlate with that of the reference gives no information.
  constexpr double kLeastAlike = 0.7, kUnlike = 0.5;
  const Matrix6d information =
      use_grey && last.correlation < kUnlike
          ? last.depth.information
          : search.information.topLeftCorner<6, 6>() - with_delay * with_delay.transpose() / search.information(6, 6);
  // A direction is open if all residuals together give it less information than this. The limit is high, because
  // residuals are many but not independent.
  constexpr double kWeakest = 1e5;  // [1/m2], [1/rad2]
  const auto axes = geometry::eigenOf<6>(information);
  match.open_directions = static_cast<int>((axes.values.array() < kWeakest).count());
  const Vector6d is_open = (axes.values.array() < kWeakest).cast<double>();
  const Vector6d to_guess = minus(inverse(guess.reference_from_image), search.image_from_reference);
  const Vector6d back = axes.vectors * is_open.asDiagonal() * axes.vectors.transpose() * to_guess;
  match.reference_from_image = inverse(plus(search.image_from_reference, back));
  const Vector6d variances =
      axes.values.unaryExpr([](double value) { return value < kWeakest ? DenseMatch::kOpen : 1 / value; });
  const Matrix6d ad = adjoint(inverse(match.reference_from_image));
  const Matrix6d in_reference = axes.vectors * variances.asDiagonal() * axes.vectors.transpose();
  match.covariance = ad * in_reference * ad.transpose();
  if (match.open_directions == 0) {
    const double by_pose = with_delay.dot(search.information.topLeftCorner<6, 6>().ldlt().solve(with_delay));
    match.delay_sigma =
        std::min(motion.delay_sigma, 1 / std::sqrt(std::max(1e-12, search.information(6, 6) - by_pose)));
  }
  // A covered lens shows neither depths nor the pattern of the reference.
  constexpr double kLeastMeasured = 0.3;
  const bool is_alike = (options_.use_depth && last.measured >= kLeastMeasured * last.shown) ||
                        (use_grey && last.correlation >= kLeastAlike);
  match.fits = last.shown > 0 && match.overlap >= options_.min_overlap &&
               match.outlier_share <= options_.max_outlier_share && is_alike;
  match.succeeded = match.fits && match.open_directions == 0;
  return match;
}

}  // namespace omnimapper::matching
