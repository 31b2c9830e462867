#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/SymmetricEigen.h>
#include <omnimapper/matching/CloudMatcher.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace omnimapper::matching {

using geometry::Matrix6d;
using geometry::Se3;
using geometry::Vector6d;

const base::OptionTable<CloudMatcherOptions>& CloudMatcherOptions::table() {
  using Options = CloudMatcherOptions;
  static const auto table =
      base::OptionTable<Options>()
          .choice("method", &Options::method,
                  {{"point_to_point", CloudMethod::point_to_point},
                   {"point_to_plane", CloudMethod::point_to_plane},
                   {"gicp", CloudMethod::gicp}},
                  "Distance that a match minimizes. point_to_point: between two points. point_to_plane: from a point "
                  "to the surface at the other point. gicp: between two points, in standard deviations.")
          .number("max_distance_m", &Options::max_distance, base::Range::positive(),
                  "Largest distance between corresponding points on the finest level of a match, the one with the most "
                  "points.")
          .number("coarse_distance_m", &Options::coarse_distance, base::Range::positive(),
                  "Largest distance between corresponding points on the coarsest level of a match, the one with the "
                  "fewest points. It is halved from level to level, down to max_distance_m.")
          .integer("max_iterations", &Options::max_iterations, base::Range{1, 1000},
                   "Largest number of iterations on each level of a match, from the coarsest to the finest.")
          .number("tolerance", &Options::tolerance, base::Range::positive(),
                  "The finest level of a match ends after a step that is shorter than this [m] [rad]. Each coarser "
                  "level ends after a step that is shorter than ten times this.")
          .integer("coarse_points", &Options::coarse_points, base::Range{10, 1000000},
                   "Largest number of points that are matched on the coarsest level of a match. Each further level has "
                   "about four times as many points, up to max_points.")
          .integer("max_points", &Options::max_points, base::Range{10, 1000000},
                   "Largest number of points that are matched on the finest level of a match.")
          .number(
              "normal_noise_deg", &Options::normal_noise, base::Range::notNegative(),
              "Standard deviation of surface normals. Because of this noise, the points of a bare wall seem to "
              "determine also the motion along the wall; the covariance of a match leaves this false information out.")
          .number("alike", &Options::alike, base::Range{1, 10000},
                  "Number of neighbouring points that share their errors and therefore count as a single measurement.")
          .number("min_overlap", &Options::min_overlap, base::Range{0, 1},
                  "A match is accepted only if at least this share of the image's points have a corresponding point in "
                  "the reference image.");
  return table;
}

IteratedClosestPoints::IteratedClosestPoints(const CloudMatcherOptions& options) : options_(options) {
  const bool are_counts = options.max_iterations > 0 && options.coarse_points > 0 && options.max_points > 0;
  const bool are_lengths = options.max_distance > 0 && options.coarse_distance > 0 && options.tolerance > 0;
  if (!are_counts || !are_lengths || !(options.alike >= 1))
    throw base::Error(base::ExitCode::out_of_range,
                      "registration of clouds: counts, distances and tolerance must be positive, alike at least 1");
}

namespace {

// A point of the source and the nearest one of the target, in the source's frame.
struct Pair {
  Eigen::Vector3f point;        // of the target
  Eigen::Vector3f off;          // from the source's point to it
  Eigen::Matrix3f information;  // inverse covariance of `off`
  float square;                 // off' information off
};

class CloudSearch {
 public:
  CloudSearch(const CloudMatcherOptions& options, const MatchCloud& target, const MatchCloud& source, const Se3& guess)
      : options_(options), target_(target), source_(source), target_from_source_(guess) {}

  // Pairs every `stride`-th point of the source with the nearest one of the target within `max_distance` [m].
  void associate(std::size_t stride, double max_distance);
  // Makes one Gauss-Newton step and returns its length [m] [rad].
  double step();
  // Computes the normal equations of the pairs: information(), and the gradient, which is returned.
  Vector6d gradient();
  double scale() const { return std::sqrt(scale_square_); }
  double overlap() const { return asked_ == 0 ? 0 : static_cast<double>(near_) / static_cast<double>(asked_); }
  std::size_t pairs() const { return pairs_.size(); }
  double medianDistance() const;
  const Se3& targetFromSource() const { return target_from_source_; }
  const Matrix6d& information() const { return information_; }
  // The information about sideways motions that normals with an error of `noise` [rad] only seem to give.
  Matrix6d informationOfNoise(double noise) const;

 private:
  double weightOf(const Pair& pair) const;
  double dimensions() const { return options_.method == CloudMethod::point_to_plane ? 1 : 3; }
  void findScale();

  const CloudMatcherOptions& options_;
  const MatchCloud& target_;
  const MatchCloud& source_;
  Se3 target_from_source_;
  std::vector<Pair> pairs_;
  std::size_t asked_ = 0, near_ = 0;
  double scale_square_ = 1;
  Matrix6d information_ = Matrix6d::Zero();  // in the source's frame
};

void CloudSearch::associate(std::size_t stride, double max_distance) {
  const Eigen::Matrix3f rotation = target_from_source_.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f translation = target_from_source_.translation.cast<float>();
  const auto farthest = static_cast<float>(max_distance);
  pairs_.clear();
  asked_ = near_ = 0;
  for (std::size_t i = 0; i < source_.size(); i += stride) {
    ++asked_;
    const Eigen::Vector3f& point = source_.cloud().points[i];
    const std::size_t j = target_.nearest(rotation * point + translation, farthest);
    if (j == MatchCloud::kNone) continue;
    ++near_;
    Pair pair;
    pair.point = rotation.transpose() * (target_.cloud().points[j] - translation);
    pair.off = pair.point - point;
    if (options_.method == CloudMethod::point_to_point) {
      pair.information.setIdentity();
    } else if (options_.method == CloudMethod::point_to_plane) {
      const Eigen::Vector3f normal = rotation.transpose() * target_.cloud().normals[j];
      if (!normal.allFinite()) continue;
      pair.information = normal * normal.transpose();
    } else {
      const Eigen::Matrix3f covariance =
          source_.cloud().covariances[i] + rotation.transpose() * target_.cloud().covariances[j] * rotation;
      pair.information = covariance.inverse();
    }
    pair.square = pair.off.dot(pair.information * pair.off);
    if (std::isfinite(pair.square)) pairs_.push_back(pair);
  }
  findScale();
}

// Estimates the scale by the median, which does not change if up to half of the pairs are wrong.
void CloudSearch::findScale() {
  if (pairs_.empty()) return;
  std::vector<float> squares;
  squares.reserve(pairs_.size());
  for (const Pair& pair : pairs_) squares.push_back(pair.square);
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  const double median_of_chi_square = dimensions() == 1 ? 0.455 : 2.366;
  // Smallest scale, because nothing is measured more precisely: [m] in the first two methods, in standard deviations in
  // the third.
  const double least = options_.method == CloudMethod::gicp ? 1e-2 : 1e-4;
  scale_square_ = std::max(least * least, *middle / median_of_chi_square);
}

// Matrix that maps a small rotation about the source's origin to the displacement of the target's point in the source's
// frame.
Eigen::Matrix3f turnOf(const Pair& pair) {
  Eigen::Matrix3f turn;
  turn << 0, -pair.point.z(), pair.point.y(), pair.point.z(), 0, -pair.point.x(), -pair.point.y(), pair.point.x(), 0;
  return turn;
}

double CloudSearch::weightOf(const Pair& pair) const {
  constexpr double kDegrees = 5;  // of freedom of Student's t
  return (kDegrees + dimensions()) / (kDegrees + pair.square / scale_square_) / scale_square_;
}

Matrix6d CloudSearch::informationOfNoise(double noise) const {
  Matrix6d sum = Matrix6d::Zero();
  for (const Pair& pair : pairs_) {
    const Eigen::Matrix3d sideways =
        (pair.information.trace() * Eigen::Matrix3f::Identity() - pair.information).cast<double>();
    Eigen::Matrix<double, 3, 6> jacobian;
    jacobian << -Eigen::Matrix3d::Identity(), turnOf(pair).cast<double>();
    sum += noise * noise * weightOf(pair) * jacobian.transpose() * sideways * jacobian;
  }
  return sum;
}

Vector6d CloudSearch::gradient() {
  Eigen::Matrix3d tt = Eigen::Matrix3d::Zero(), tw = tt, ww = tt;
  Eigen::Vector3d t = Eigen::Vector3d::Zero(), w = t;
  for (const Pair& pair : pairs_) {
    const Eigen::Matrix3f information = static_cast<float>(weightOf(pair)) * pair.information, turn = turnOf(pair);
    const Eigen::Matrix3f turned = information * turn;
    const Eigen::Vector3f force = information * pair.off;
    tt += information.cast<double>();
    tw -= turned.cast<double>();
    ww += (turn.transpose() * turned).cast<double>();
    t -= force.cast<double>();
    w += (turn.transpose() * force).cast<double>();
  }
  information_ << tt, tw, tw.transpose(), ww;
  Vector6d gradient;
  gradient << t, w;
  return gradient;
}

double CloudSearch::step() {
  const Vector6d downhill = -gradient();
  // Directions that the pairs leave open stay as they are.
  const Matrix6d held = information_ + 1e-9 * information_.trace() * Matrix6d::Identity();
  const Vector6d step = held.ldlt().solve(downhill);
  if (!step.allFinite()) return 0;
  target_from_source_ = plus(target_from_source_, step);
  return std::max(step.head<3>().norm(), step.tail<3>().norm());
}

double CloudSearch::medianDistance() const {
  if (pairs_.empty()) return 0;
  std::vector<float> distances;
  for (const Pair& pair : pairs_) distances.push_back(pair.off.norm());
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

void requireWhatIsNeeded(CloudMethod method, const MatchCloud& target, const MatchCloud& source) {
  if (method == CloudMethod::point_to_plane && target.size() > 0 && target.cloud().normals.empty())
    throw base::Error(base::ExitCode::out_of_range, "registration by planes needs the normals of the target's points");
  const bool are_shaped = (target.size() == 0 || !target.cloud().covariances.empty()) &&
                          (source.size() == 0 || !source.cloud().covariances.empty());
  if (method == CloudMethod::gicp && !are_shaped)
    throw base::Error(base::ExitCode::out_of_range,
                      "registration by GICP needs the covariances of both clouds' points");
}

constexpr std::size_t kFewestPoints = 6;  // fewer do not determine a motion

// The stride is odd: the widths of images have factors of two, so an even stride would meet the same few columns in
// every row.
std::size_t strideOf(const MatchCloud& source, double points) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(static_cast<double>(source.size()) / points))) | 1U;
}

// Fills in the result, from the pairs at the end of the search.
void conclude(const CloudSearch& search, const CloudMatcherOptions& options, const Se3& guess, CloudMatch& match) {
  match.target_from_source = search.targetFromSource();
  match.residual = search.medianDistance();
  // A direction is open if all pairs together give it less information than this.
  constexpr double kWeakest = 1e4;  // [1/m2], [1/rad2]
  const bool by_surfaces = options.method != CloudMethod::point_to_point;
  const Matrix6d noise = by_surfaces ? search.informationOfNoise(options.normal_noise) : Matrix6d(Matrix6d::Zero());
  const auto axes = geometry::eigenOf<6>((search.information() - noise) / options.alike);
  match.open_directions = static_cast<int>((axes.values.array() < kWeakest).count());
  const Vector6d variances =
      axes.values.unaryExpr([](double value) { return value < kWeakest ? CloudMatch::kOpen : 1 / value; });
  match.covariance = axes.vectors * variances.asDiagonal() * axes.vectors.transpose();
  match.fits = true;
  if (match.open_directions > 0) {
    // Along open directions the pairs give no information, so the guess is kept.
    Vector6d moved = axes.vectors.transpose() * minus(match.target_from_source, guess);
    for (int i = 0; i < 6; ++i) moved(i) = axes.values(i) < kWeakest ? 0 : moved(i);
    match.target_from_source = plus(guess, axes.vectors * moved);
  }
  match.succeeded = match.open_directions == 0;
}

}  // namespace

CloudMatch IteratedClosestPoints::match(const MatchCloud& target, const MatchCloud& source, const Se3& guess) const {
  requireWhatIsNeeded(options_.method, target, source);
  CloudMatch match;
  match.target_from_source = guess;
  if (target.size() < kFewestPoints || source.size() < kFewestPoints) return match;
  const std::size_t finest = strideOf(source, options_.max_points);
  CloudSearch search(options_, target, source, guess);
  double distance = std::max(options_.coarse_distance, options_.max_distance);
  for (std::size_t stride = std::max(finest, strideOf(source, options_.coarse_points));;) {
    const bool is_last = stride == finest && distance <= options_.max_distance;
    // A coarse level may end earlier, because the next one improves its result.
    const double enough = is_last ? options_.tolerance : 10 * options_.tolerance;
    for (int i = 0; i < options_.max_iterations; ++i) {
      search.associate(stride, distance);
      ++match.iterations;
      match.overlap = search.overlap();
      if (match.overlap < options_.min_overlap || search.pairs() < kFewestPoints) return match;
      if (search.step() < enough) break;
    }
    if (is_last) break;
    stride = std::max(finest, (stride / 4) | 1U);
    distance = std::max(options_.max_distance, distance / 2);
  }
  conclude(search, options_, guess, match);
  return match;
}

CloudMatch IteratedClosestPoints::judged(const MatchCloud& target, const MatchCloud& source, const Se3& guess,
                                         const Se3& target_from_source) const {
  requireWhatIsNeeded(options_.method, target, source);
  CloudMatch match;
  match.target_from_source = guess;
  if (target.size() < kFewestPoints || source.size() < kFewestPoints) return match;
  CloudSearch search(options_, target, source, target_from_source);
  search.associate(strideOf(source, options_.max_points), options_.max_distance);
  match.overlap = search.overlap();
  if (match.overlap < options_.min_overlap || search.pairs() < kFewestPoints) return match;
  search.gradient();
  conclude(search, options_, guess, match);
  return match;
}

}  // namespace omnimapper::matching
