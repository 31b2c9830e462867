#include <omnimapper/mapper/Trigger.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::mapper {

const base::OptionTable<TriggerOptions>& TriggerOptions::table() {
  using Options = TriggerOptions;
  static const auto table =
      base::OptionTable<Options>()
          .flag("every_observation", &Options::every_observation, "Every observation becomes a key frame.")
          .number("distance_m", &Options::distance, base::Range::positive(),
                  "Distance moved since the sensor's last key frame, measured by the pose plugins, at which a new "
                  "one is made.")
          .number("angle_deg", &Options::angle, base::Range{0.01, 180},
                  "Rotation since the sensor's last key frame, measured by the pose plugins, at which a new one is "
                  "made.")
          .number("period_s", &Options::period, base::Range::notNegative(),
                  "Time since the sensor's last key frame after which a new one is made even at rest; 0 disables "
                  "this.")
          .number("period_without_odometry_s", &Options::period_without_odometry, base::Range::notNegative(),
                  "Time since the sensor's last key frame after which a new one is made where no pose plugin has "
                  "measured the motion.");
  return table;
}

namespace {
double rotationAngle(const mrpt::poses::CPose3D& pose) {
  const auto r = pose.getRotationMatrix();
  const double cosine = (r(0, 0) + r(1, 1) + r(2, 2) - 1) / 2;
  return std::acos(std::fmax(-1.0, std::fmin(1.0, cosine)));
}
}  // namespace

bool Trigger::isDue(const Since& since) const {
  const double elapsed = base::secondsBetween(since.fired, since.newest);
  if (options_.every_observation || (options_.period > 0 && elapsed >= options_.period)) return true;
  if (!since.motion) return elapsed >= options_.period_without_odometry;
  return since.motion->translation().norm() >= options_.distance || rotationAngle(*since.motion) >= options_.angle;
}

bool Trigger::fires(const std::string& label, base::Stamp stamp, const MotionBetween& motion) {
  const auto [entry, first] = labels_.try_emplace(label, Since{stamp, stamp, mrpt::poses::CPose3D()});
  if (first) {
    entry->second.all_fired.insert(stamp);
    return true;
  }
  Since& since = entry->second;
  // The motion is summed step by step, because the cost of asking for the whole span would grow while the robot rests.
  const auto step = motion(since.newest, stamp);
  since.motion = step && since.motion ? std::make_optional(*since.motion + step->begin_from_end) : std::nullopt;
  since.newest = stamp;
  if (!isDue(since)) return false;
  since.fired = stamp;
  since.motion = mrpt::poses::CPose3D();
  since.all_fired.insert(stamp);
  return true;
}

bool Trigger::firesLate(const std::string& label, base::Stamp stamp, const MotionBetween& motion) {
  const auto entry = labels_.find(label);
  if (entry == labels_.end()) return fires(label, stamp, motion);
  Since& since = entry->second;
  const auto isFar = [&](base::Stamp begin, base::Stamp end) {
    const auto measured = motion(begin, end);
    return isDue({begin, end, measured ? std::make_optional(measured->begin_from_end) : std::nullopt});
  };
  const auto after = since.all_fired.lower_bound(stamp);
  if (after != since.all_fired.end() && *after == stamp) return false;
  const bool near_after = after != since.all_fired.end() && !isFar(stamp, *after);
  const bool near_before = after != since.all_fired.begin() && !isFar(*std::prev(after), stamp);
  if (!options_.every_observation && (near_after || near_before)) return false;
  const bool newest = after == since.all_fired.end();
  since.all_fired.insert(stamp);
  if (newest) {
    const auto measured = motion(stamp, std::max(stamp, since.newest));
    since.fired = stamp;
    since.newest = std::max(stamp, since.newest);
    since.motion = measured ? std::make_optional(measured->begin_from_end) : std::nullopt;
  }
  return true;
}

void Trigger::forgetBefore(base::Stamp stamp) {
  // The last one before `stamp` is kept, because a late observation may follow it.
  for (auto& [label, since] : labels_) {
    const auto kept = since.all_fired.upper_bound(stamp);
    if (kept != since.all_fired.begin()) since.all_fired.erase(since.all_fired.begin(), std::prev(kept));
  }
}

}  // namespace omnimapper::mapper
