#include <omnimapper/matching/RgbdTracker.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

namespace omnimapper::matching {

namespace {

using geometry::Matrix6d;
using geometry::Se3;
using geometry::Vector6d;
using How = RgbdTracker::Tracked::How;

// Largest motions of a hand or a robot: [m] [rad] off the motion that wheels or a gyroscope measured, beyond its
// uncertainty; and where no motion is measured, [m] [rad] plus [m/s] [rad/s].
constexpr double kMeasuredSlack = 0.1, kMeasuredSlackTurn = 0.15;
constexpr double kSlack = 0.3, kSlackTurn = 0.3, kFastest = 1.5, kFastestTurn = 4;

double angleOf(const Se3& pose) {
  return geometry::logSo3(pose.rotation).norm();
}

}  // namespace

const base::OptionTable<RgbdTrackerOptions>& RgbdTrackerOptions::table() {
  using Options = RgbdTrackerOptions;
  const auto any = base::Range{-0.1, 0.1};
  static const auto table =
      base::OptionTable<Options>()
          .number(
              "key_angle_deg", &Options::key_angle, base::Range{0.5, 90},
              "Each image is matched with an earlier one, its reference image. An image that is rotated by more than "
              "this from its reference image becomes a reference image, too, unless another reference image is near.")
          .number("key_distance_share", &Options::key_distance, base::Range{0.005, 1},
                  "Each image is matched with an earlier one, its reference image. An image becomes a reference image, "
                  "too, if it was taken farther from its reference image than this share of the reference image's "
                  "median depth, unless another reference image is near.")
          .number("key_overlap", &Options::key_overlap, base::Range{0.3, 1},
                  "Each image is matched with an earlier one, its reference image. An image that shows less than this "
                  "share of its reference image's points becomes a reference image, too, unless another reference "
                  "image is near.")
          .integer("key_frames", &Options::key_frames, base::Range{1, 10000},
                   "Largest number of reference images that are kept. Later images are matched with them again when "
                   "the camera comes back to where they were taken.")
          .number("acceleration_m_per_s2", &Options::acceleration, base::Range::positive(),
                  "Standard deviation of the camera's linear acceleration, from which the uncertainty of a "
                  "motion prediction is computed.")
          .number("turn_acceleration_rad_per_s2", &Options::turn_acceleration, base::Range::positive(),
                  "Standard deviation of the camera's angular acceleration, from which the uncertainty of a "
                  "motion prediction is computed.")
          .number("depth_readout_s", &Options::depth_readout, any,
                  "Time from the first row of a depth image to its last; 0 if all rows are taken at once.")
          .number("picture_readout_s", &Options::picture_readout, any,
                  "Time from the first row of a picture to its last; 0 if all rows are taken at once.")
          .number("picture_delay_s", &Options::picture_delay, any,
                  "Time from the middle row of a depth image to the middle row of its picture.")
          .number("picture_delay_sigma_s", &Options::picture_delay_sigma, base::Range{0, 0.1},
                  "Each match estimates the delay between depth image and picture. Standard deviation of this delay "
                  "before the estimate; 0 if picture_delay_s is exact.")
          .number("longest_loss_s", &Options::longest_loss, base::Range::positive(),
                  "Tracking starts anew if no image could be matched for longer than this.")
          .flag("use_features", &Options::use_features,
                "Matches corners of the pictures, too, where depths and brightness give no sure match, for example in "
                "a fast motion.");
  return table;
}

RgbdTracker::RgbdTracker(const RgbdTrackerOptions& options, const DenseMatcherOptions& matching,
                         const FeatureMatcherOptions& features)
    : options_(options), matcher_(matching), feature_matcher_(features) {}

CameraMotion RgbdTracker::motion() const {
  return {velocity_, options_.depth_readout, options_.picture_delay, options_.picture_readout,
          options_.picture_delay_sigma};
}

double RgbdTracker::farness(const KeyFrame& key, const Se3& map_from_camera) const {
  const Se3 off = inverse(key.map_from_camera) * map_from_camera;
  return std::max(angleOf(off) / options_.key_angle, off.translation.norm() / (options_.key_distance * key.depth));
}

std::optional<std::size_t> RgbdTracker::nearest(const Se3& map_from_camera, double farthest,
                                                std::optional<std::size_t> but) const {
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    if (k == but) continue;
    const double far = farness(keys_[k], map_from_camera);
    if (far >= farthest) continue;
    farthest = far;
    best = k;
  }
  return best;
}

DenseMatch RgbdTracker::match(std::size_t key, const Image& image, const Se3& map_from_camera,
                              const Matrix6d& information, const CameraMotion& motion) const {
  return matcher_.match(*keys_[key].reference, image.pyramid,
                        {inverse(keys_[key].map_from_camera) * map_from_camera, information}, motion);
}

RgbdTracker::Tracked RgbdTracker::begin(base::Stamp stamp, const Image& image, const Se3& map_from_camera) {
  velocity_.setZero();
  keys_.clear();  // their poses relative to this image are not known
  makeKeyFrame(stamp, image, map_from_camera, options_.picture_delay);
  last_ = constrained_ = stamp;
  map_from_last_ = map_from_camera;
  is_lost_ = false;
  Tracked tracked;
  tracked.map_from_camera = map_from_camera;
  tracked.last = stamp;
  tracked.is_key_frame = true;
  return tracked;
}

void RgbdTracker::makeKeyFrame(base::Stamp stamp, const Image& image, const Se3& map_from_camera,
                               double picture_delay) {
  CameraMotion moved = motion();
  moved.picture_delay = picture_delay;
  keys_.push_back({matcher_.prepare(image.pyramid, moved), options_.use_features ? featuresOf(image) : nullptr, stamp,
                   map_from_camera, image.pyramid.medianDepth().value()});
  if (keys_.size() > static_cast<std::size_t>(options_.key_frames)) keys_.pop_front();
  current_ = keys_.size() - 1;
}

// Matches with the key frame of the last image, from the expected pose. If that does not fit, or has many outliers in
// depth, the last pose and the key frames nearest to either pose are tried, too; the match with the fewest outliers is
// taken. A match that fits but leaves directions open keeps the expected motion there. The motion that is found
// corrects the rolling shutter better than the last one did, so the match is repeated with the mean of both.
std::optional<RgbdTracker::Found> RgbdTracker::follow(const Image& image, const Expected& expected,
                                                      double seconds) const {
  constexpr double kFarthest = 3, kUnreliable = 0.1;
  const Matrix6d nothing = Matrix6d::Zero();
  const Se3& unmoved = expected.is_measured ? map_from_last_ : expected.about;
  std::vector<std::pair<std::size_t, Se3>> tries{{current_, expected.map_from_camera}, {current_, unmoved}};
  for (const auto& [key, pose] : std::vector(tries)) {
    const auto other = nearest(pose, kFarthest, key);
    if (other) tries.emplace_back(*other, pose);
  }
  std::optional<Found> best, blind;
  for (std::size_t i = 0; i < tries.size() && !blind; ++i) {
    const auto& [key, pose] = tries[i];
    const Matrix6d& known = i == 0 ? expected.information : nothing;
    const auto first = match(key, image, pose, known, motion());
    const Se3 map_from_camera = keys_[key].map_from_camera * first.reference_from_image;
    if (!first.fits || !expected.allows(map_from_camera)) continue;
    // Other key frames that seem to determine the whole motion are usually wrong: one bare wall looks like another.
    if (i == 0 && first.open_directions > 0 && first.outlier_share < kUnreliable) blind = Found{key, first};
    if (!first.succeeded) continue;
    CameraMotion moved = motion();
    moved.velocity = 0.5 * (velocity_ + minus(inverse(map_from_last_) * map_from_camera, Se3{}) / seconds);
    const auto second = match(key, image, i == 0 ? pose : map_from_camera, known, moved);
    const bool is_better =
        second.succeeded && expected.allows(keys_[key].map_from_camera * second.reference_from_image);
    const Found found{key, is_better ? second : first};
    if (!best || found.match.outlier_share < best->match.outlier_share) best = found;
    if (best->match.outlier_share < kUnreliable) break;
  }
  // A motion measured by wheels is a better initial pose than corners give.
  if (options_.use_features && !expected.is_measured && (!best || best->match.outlier_share >= kUnreliable)) {
    std::vector<std::size_t> keys;
    for (const auto& [key, pose] : tries)
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    const auto other = followByFeatures(keys, image, expected, seconds);
    if (other && (!best || other->match.outlier_share < best->match.outlier_share)) best = other;
  }
  return best ? best : blind;
}

const std::shared_ptr<const FeatureSet>& RgbdTracker::featuresOf(const Image& image) const {
  if (!image.features) image.features = feature_matcher_.prepare(image.pyramid);
  return image.features;
}

// Matches from the poses that corners give.
std::optional<RgbdTracker::Found> RgbdTracker::followByFeatures(const std::vector<std::size_t>& keys,
                                                                const Image& image, const Expected& expected,
                                                                double seconds) const {
  std::optional<Found> best;
  for (const std::size_t key : keys) {
    const auto corners = feature_matcher_.match(*keys_[key].features, *featuresOf(image));
    const Se3 map_from_camera = keys_[key].map_from_camera * corners.reference_from_image;
    if (!corners.succeeded || !expected.allows(map_from_camera)) continue;
    CameraMotion moved = motion();
    moved.velocity = minus(inverse(map_from_last_) * map_from_camera, Se3{}) / seconds;
    const auto found = match(key, image, map_from_camera, Matrix6d::Zero(), moved);
    if (!found.succeeded || !expected.allows(keys_[key].map_from_camera * found.reference_from_image)) continue;
    if (!best || found.outlier_share < best->match.outlier_share) best = Found{key, found};
  }
  return best;
}

// Finds a lost camera: by the key frames that share most corners with the image, else by every key frame, as if the
// camera were there again. The best match is taken.
std::optional<RgbdTracker::Found> RgbdTracker::seek(const Image& image, const Expected& expected) const {
  CameraMotion unknown = motion();
  unknown.velocity.setZero();
  std::optional<Found> best;
  if (!image.pyramid.medianDepth()) return best;
  constexpr double kSurely = 0.5, kOutlierShare = 0.1;  // the camera may be anywhere, so only good matches are accepted
  const Matrix6d known = expected.is_measured ? expected.information : Matrix6d::Zero();
  const auto tryFrom = [&](std::size_t key, const Se3& map_from_camera, double least_overlap) {
    const auto found = match(key, image, map_from_camera, known, unknown);
    if (!found.succeeded || found.overlap < least_overlap || found.outlier_share > kOutlierShare) return;
    if (!expected.allows(keys_[key].map_from_camera * found.reference_from_image)) return;
    if (!best || found.outlier_share < best->match.outlier_share) best = Found{key, found};
  };
  constexpr double kSeenBefore = 0.2;  // smallest overlap; corners show that it is the same place
  if (!expected.is_measured)
    for (const auto& [key, pose] : posesByFeatures(image)) tryFrom(key, pose, kSeenBefore);
  if (best) return best;
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    Se3 there = expected.is_measured ? expected.map_from_camera : keys_[k].map_from_camera;
    if (expected.is_turn_measured) there.rotation = expected.map_from_camera.rotation;
    tryFrom(k, there, kSurely);
  }
  return best;
}

// The poses by the few key frames that share most corners with the image.
std::vector<std::pair<std::size_t, Se3>> RgbdTracker::posesByFeatures(const Image& image) const {
  constexpr std::size_t kMost = 3;
  std::vector<std::pair<std::size_t, std::pair<std::size_t, Se3>>> all;  // with the number of corners
  for (std::size_t k = 0; options_.use_features && k < keys_.size(); ++k) {
    const auto corners = feature_matcher_.match(*keys_[k].features, *featuresOf(image));
    if (corners.succeeded)
      all.push_back({corners.inliers, {k, keys_[k].map_from_camera * corners.reference_from_image}});
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::pair<std::size_t, Se3>> poses;
  for (std::size_t i = 0; i < std::min(kMost, all.size()); ++i) poses.push_back(all[i].second);
  return poses;
}

RgbdTracker::Tracked RgbdTracker::take(base::Stamp stamp, const Image& image, Found found, const Expected& expected,
                                       How how, double seconds) {
  current_ = found.key;
  Se3 map_from_camera = keys_[current_].map_from_camera * found.match.reference_from_image;
  const bool is_far = farness(keys_[current_], map_from_camera) > 1 || found.match.overlap < options_.key_overlap;
  Tracked tracked;
  if (is_far && image.pyramid.medianDepth()) {
    // Use an earlier key frame if its view is much nearer than where a new one is due.
    constexpr double kMuchNearer = 0.8;
    const auto other = nearest(map_from_camera, kMuchNearer, current_);
    std::optional<DenseMatch> again;
    if (other) again = match(*other, image, map_from_camera, Matrix6d::Zero(), motion());
    const auto isThere = [&] { return expected.allows(keys_[*other].map_from_camera * again->reference_from_image); };
    if (again && again->succeeded && again->overlap > options_.key_overlap && isThere()) {
      constexpr std::size_t kLongBefore = 5;  // key frames
      if (keys_.size() - *other > kLongBefore) tracked.seen_before = keys_[*other].stamp;
      current_ = *other;
      found.match = *again;
      map_from_camera = keys_[current_].map_from_camera * again->reference_from_image;
    } else {
      tracked.is_key_frame = true;
    }
  }
  tracked.how = how;
  tracked.match = found.match;
  tracked.map_from_camera = map_from_camera;
  tracked.last_from_camera = inverse(map_from_last_) * map_from_camera;
  tracked.last = *last_;
  velocity_ = how == How::found ? Vector6d::Zero().eval() : (minus(tracked.last_from_camera, Se3{}) / seconds).eval();
  if (found.match.open_directions == 0 || expected.is_measured) constrained_ = stamp;
  map_from_last_ = map_from_camera;
  last_ = stamp;
  is_lost_ = false;
  if (tracked.is_key_frame) makeKeyFrame(stamp, image, map_from_camera, found.match.delay);
  return tracked;
}

bool RgbdTracker::Expected::allows(const Se3& found) const {
  const Se3 off = inverse(about) * found;
  return off.translation.norm() < most && angleOf(off) < most_turn;
}

RgbdTracker::Expected RgbdTracker::expectedOfLate(double seconds) const {
  Expected expected;
  // A hand soon changes its motion. Without fading, a motion that images hardly constrain would go on and on.
  constexpr double kGoesOn = 0.4;  // [s]
  expected.map_from_camera =
      map_from_last_ * geometry::plus(Se3{}, kGoesOn * (1 - std::exp(-seconds / kGoesOn)) * velocity_);
  const double change = 0.5 * seconds * seconds;
  expected.information.diagonal().head<3>().setConstant(1 / std::pow(change * options_.acceleration, 2));
  expected.information.diagonal().tail<3>().setConstant(1 / std::pow(change * options_.turn_acceleration, 2));
  expected.about = map_from_last_;
  expected.most = kSlack + kFastest * seconds;
  expected.most_turn = kSlackTurn + kFastestTurn * seconds;
  return expected;
}

RgbdTracker::Expected RgbdTracker::expectedAfter(double seconds,
                                                 const std::optional<motion::PredictedMotion>& prediction) const {
  Expected expected = expectedOfLate(seconds);
  if (!prediction) return expected;
  constexpr double kSigmas = 5;
  const Se3 map_from_camera = map_from_last_ * prediction->last_from_camera;
  const Matrix6d& covariance = prediction->covariance;
  expected.about = map_from_camera;
  expected.most_turn = kMeasuredSlackTurn + kSigmas * std::sqrt(covariance.bottomRightCorner<3, 3>().trace());
  expected.is_turn_measured = true;
  if (prediction->only_turn) {
    expected.map_from_camera.rotation = map_from_camera.rotation;
    expected.information.bottomRightCorner<3, 3>() = covariance.bottomRightCorner<3, 3>().inverse();
    return expected;
  }
  expected.map_from_camera = map_from_camera;
  expected.information = covariance.inverse();
  expected.most = kMeasuredSlack + kSigmas * std::sqrt(covariance.topLeftCorner<3, 3>().trace());
  expected.is_measured = true;
  return expected;
}

RgbdTracker::Tracked RgbdTracker::lostAt(base::Stamp last) const {
  Tracked lost;
  lost.how = How::lost;
  lost.map_from_camera = map_from_last_;
  lost.last = last;
  return lost;
}

RgbdTracker::Tracked RgbdTracker::track(base::Stamp stamp, const RgbdPyramid& pyramid,
                                        const std::optional<motion::PredictedMotion>& prediction) {
  const bool can_begin = pyramid.medianDepth().has_value();
  const Image image{pyramid};
  if (!last_ && can_begin) return begin(stamp, image, Se3{});
  if (!last_) return lostAt(stamp);
  // With stamps that nearly coincide, noise would become a velocity.
  constexpr double kShortest = 0.01;  // [s]
  const double seconds = std::max(kShortest, base::secondsBetween(*last_, stamp));
  const Expected expected = expectedAfter(seconds, prediction);
  if (!is_lost_) {
    const auto found = follow(image, expected, seconds);
    const bool is_constrained = found && (found->match.open_directions == 0 || expected.is_measured ||
                                          base::secondsBetween(*constrained_, stamp) <= options_.longest_loss);
    if (is_constrained) return take(stamp, image, *found, expected, How::tracked, seconds);
  }
  if (const auto found = seek(image, expected)) return take(stamp, image, *found, expected, How::found, seconds);
  is_lost_ = true;
  velocity_.setZero();
  if (seconds > options_.longest_loss && can_begin)
    return begin(stamp, image, expected.is_measured ? expected.map_from_camera : map_from_last_);
  return lostAt(*last_);
}

}  // namespace omnimapper::matching
