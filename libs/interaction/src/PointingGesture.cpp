#include <omnimapper/interaction/PointingGesture.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::interaction {

namespace {

using Eigen::Vector3d;

// The angle between the forearm and the vertical downwards; without an elbow, that of the line from the head.
double angleFromDown(const Vector3d& from, const Vector3d& hand) {
  const Vector3d along = hand - from;
  return std::atan2(along.head<2>().norm(), -along.z());
}

}  // namespace

const base::OptionTable<GestureOptions>& GestureOptions::table() {
  using O = GestureOptions;
  static const auto table =
      base::OptionTable<O>()
          .number("min_forearm_deg", &O::min_angle, {0, 180},
                  "Angle from the vertical downwards from which on a forearm points.")
          .number("still_s", &O::still_time, {0.05, 10}, "Time for which elbow and hand are held still.")
          .number("still_radius_m", &O::still_radius, base::Range::positive(),
                  "Largest distance of a joint from its mean while it is held still.");
  return table;
}

PointingGesture transformed(const geometry::Se3& there_from_here, PointingGesture gesture) {
  gesture.hand = there_from_here * gesture.hand;
  gesture.sensor = there_from_here * gesture.sensor;
  for (auto* joint : {&gesture.elbow, &gesture.head})
    if (*joint) *joint = there_from_here * **joint;
  return gesture;
}

std::optional<PointingGesture> GestureWatch::meanOf(const Arm& arm) const {
  PointingGesture mean;
  mean.begin = arm.samples.front().stamp;
  mean.end = arm.samples.back().stamp;
  mean.frames = static_cast<int>(arm.samples.size());
  mean.hold = arm.hold;
  Vector3d elbow = Vector3d::Zero(), head = Vector3d::Zero();
  int elbows = 0, heads = 0;
  for (const Sample& sample : arm.samples) {
    mean.hand += sample.hand;
    mean.sensor += sample.sensor;
    if (sample.elbow) elbow += *sample.elbow, ++elbows;
    if (sample.head) head += *sample.head, ++heads;
  }
  mean.hand /= mean.frames;
  mean.sensor /= mean.frames;
  elbow /= std::max(1, elbows);
  head /= std::max(1, heads);
  if (elbows > 0) mean.elbow = elbow;
  if (heads > 0) mean.head = head;
  for (const Sample& sample : arm.samples) {
    if ((sample.hand - mean.hand).norm() > options_.still_radius) return std::nullopt;
    if (sample.elbow && (*sample.elbow - elbow).norm() > options_.still_radius) return std::nullopt;
  }
  if (angleFromDown(elbows > 0 ? elbow : head, mean.hand) <= options_.min_angle) return std::nullopt;
  return mean;
}

std::optional<PointingGesture> GestureWatch::watch(Arm& arm, bool is_right, base::Stamp stamp,
                                                   const TrackedBody& body) const {
  const BodyArm& now = body.arm(is_right);
  // A guessed joint would turn its ray by more than people miss.
  const auto isSeen = [](const std::optional<BodyJoint>& joint) { return joint && !joint->is_guessed; };
  if (!isSeen(now.hand) || (!isSeen(now.elbow) && !isSeen(body.head))) {
    arm.samples.clear();
    arm.is_holding = false;
    return std::nullopt;
  }
  Sample sample{stamp, now.hand->at, body.sensor, {}, {}};
  if (isSeen(now.elbow)) sample.elbow = now.elbow->at;
  if (isSeen(body.head)) sample.head = body.head->at;
  arm.samples.push_back(sample);
  // The window is as short as it can be without being shorter than still_time.
  while (arm.samples.size() > 1 && base::secondsBetween(arm.samples[1].stamp, stamp) >= options_.still_time)
    arm.samples.pop_front();
  if (base::secondsBetween(arm.samples.front().stamp, stamp) < options_.still_time) return std::nullopt;
  auto gesture = meanOf(arm);
  if (gesture && !arm.is_holding) gesture->hold = ++arm.hold;
  arm.is_holding = gesture.has_value();
  if (gesture) gesture->is_right_arm = is_right;
  return gesture;
}

std::vector<PointingGesture> GestureWatch::add(base::Stamp stamp, const TrackedBody& body) {
  constexpr double kLongestGap = 1;  // [s]
  if (last_ != base::Stamp() && (stamp <= last_ || base::secondsBetween(last_, stamp) > kLongestGap)) {
    for (Arm* arm : {&left_, &right_}) {
      arm->samples.clear();
      arm->is_holding = false;
    }
  }
  last_ = stamp;
  std::vector<PointingGesture> gestures;
  for (const bool is_right : {true, false})
    if (auto gesture = watch(is_right ? right_ : left_, is_right, stamp, body)) gestures.push_back(*gesture);
  return gestures;
}

}  // namespace omnimapper::interaction
