#include <omnimapper/matching/CloudTracker.h>

#include <utility>

namespace omnimapper::matching {

using geometry::Se3;

const base::OptionTable<CloudTrackerOptions>& CloudTrackerOptions::table() {
  using Options = CloudTrackerOptions;
  static const auto table =
      base::OptionTable<Options>()
          .number("key_angle_deg", &Options::key_angle, base::Range::positive(),
                  "Each image is matched with an earlier one, the reference image. An image that is rotated by more "
                  "than this from the reference image becomes the next reference image.")
          .number("key_distance_m", &Options::key_distance, base::Range::positive(),
                  "Each image is matched with an earlier one, the reference image. An image that was taken farther "
                  "than this from where the reference image was taken becomes the next reference image.")
          .number("key_overlap", &Options::key_overlap, base::Range{0, 1},
                  "Each image is matched with an earlier one, the reference image. An image becomes the next reference "
                  "image if less than this share of its points are near points of the reference image.")
          .number("longest_loss_s", &Options::longest_loss, base::Range::positive(),
                  "Tracking starts anew if no image could be matched for longer than this.");
  return table;
}

CloudTracker::CloudTracker(const CloudTrackerOptions& options, std::unique_ptr<const CloudMatcher> matcher)
    : options_(options), matcher_(std::move(matcher)) {}

CloudTracker::Tracked CloudTracker::begin(base::Stamp stamp, std::shared_ptr<const MatchCloud> cloud) {
  constexpr std::size_t kFewest = 50;  // points; tracking does not begin with an image that has fewer
  Tracked tracked;
  tracked.last = stamp;
  velocity_.setZero();
  if (cloud->size() < kFewest) {
    tracked.how = Tracked::How::lost;
    return tracked;
  }
  key_ = cloud;
  last_ = Image{std::move(cloud), {}, stamp, stamp};
  return tracked;
}

bool CloudTracker::isFarFromKey(const CloudMatch& match, const Se3& key_from_camera) const {
  return match.overlap < options_.key_overlap || key_from_camera.translation.norm() > options_.key_distance ||
         geometry::logSo3(key_from_camera.rotation).norm() > options_.key_angle;
}

CloudMatch CloudTracker::matchFrom(const MatchCloud& target, const MatchCloud& cloud, const Se3& target_from_last,
                                   const std::optional<Se3>& predicted) const {
  if (predicted) {
    auto moving = matcher_->match(target, cloud, target_from_last * *predicted);
    if (moving.fits) return moving;
  }
  auto still = matcher_->match(target, cloud, target_from_last);
  // In open directions the camera would stay where it was, which is not what was predicted.
  if (predicted && still.open_directions > 0) still.fits = false;
  return still;
}

std::optional<Se3> CloudTracker::motionTo(double seconds,
                                          const std::optional<motion::PredictedMotion>& prediction) const {
  if (prediction && !prediction->only_turn) return prediction->last_from_camera;
  if (!prediction && velocity_.isZero()) return std::nullopt;
  Se3 motion = geometry::plus(Se3{}, seconds * velocity_);
  if (prediction) motion.rotation = prediction->last_from_camera.rotation;
  return motion;
}

CloudTracker::Tracked CloudTracker::track(base::Stamp stamp, std::shared_ptr<const MatchCloud> cloud,
                                          const std::optional<motion::PredictedMotion>& prediction) {
  if (!last_) return begin(stamp, std::move(cloud));
  const double seconds = base::secondsBetween(last_->stamp, stamp);
  Tracked tracked;
  tracked.last = last_->stamp;
  const auto predicted = motionTo(seconds, prediction);
  tracked.match = matchFrom(*key_, *cloud, last_->key_from_camera, predicted);
  if (!tracked.match.fits && last_->cloud != key_) {
    key_ = last_->cloud;
    last_->key_from_camera = {};
    tracked.match = matchFrom(*key_, *cloud, {}, predicted);
  }
  const bool is_measured = prediction && !prediction->only_turn;
  const bool is_blind = tracked.match.open_directions > 0 && !is_measured;
  if (!tracked.match.fits || (is_blind && base::secondsBetween(last_->constrained, stamp) > options_.longest_loss)) {
    if (seconds > options_.longest_loss) return begin(stamp, std::move(cloud));
    velocity_.setZero();
    tracked.how = Tracked::How::lost;
    return tracked;
  }
  tracked.how = Tracked::How::tracked;
  const Se3 key_from_camera = tracked.match.target_from_source;
  tracked.last_from_camera = inverse(last_->key_from_camera) * key_from_camera;
  if (seconds > 0) velocity_ = minus(tracked.last_from_camera, Se3{}) / seconds;
  last_ = Image{cloud, key_from_camera, stamp, is_blind ? last_->constrained : stamp};
  if (isFarFromKey(tracked.match, key_from_camera)) {
    key_ = std::move(cloud);
    last_->key_from_camera = {};
  }
  return tracked;
}

}  // namespace omnimapper::matching
