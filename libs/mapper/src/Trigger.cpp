#include <omnimapper/mapper/Trigger.h>

#include <cmath>

namespace omnimapper::mapper {

const base::OptionTable<TriggerOptions>& TriggerOptions::table() {
  using Options = TriggerOptions;
  static const auto table =
      base::OptionTable<Options>()
          .flag("every_observation", &Options::every_observation, "Every observation becomes a key frame.")
          .number("distance_m", &Options::distance, base::Range::positive(),
                  "A key frame after this way, by odometry.")
          .number("angle_deg", &Options::angle, base::Range{0.01, 180}, "A key frame after this turn, by odometry.")
          .number("period_s", &Options::period, base::Range::notNegative(),
                  "A key frame after this time even at rest; 0 for never.")
          .number("period_without_odometry_s", &Options::period_without_odometry, base::Range::notNegative(),
                  "A key frame after this time where no odometry tells the motion.");
  return table;
}

namespace {
double rotationAngle(const mrpt::poses::CPose3D& pose) {
  const auto r = pose.getRotationMatrix();
  const double cosine = (r(0, 0) + r(1, 1) + r(2, 2) - 1) / 2;
  return std::acos(std::fmax(-1.0, std::fmin(1.0, cosine)));
}
}  // namespace

bool Trigger::fires(const std::string& label, base::Stamp stamp, const MotionSince& motion) {
  const auto [last, first] = last_.try_emplace(label, stamp);
  if (first) return true;
  const double elapsed = base::secondsBetween(last->second, stamp);
  bool fired = options_.every_observation || (options_.period > 0 && elapsed >= options_.period);
  if (!fired) {
    if (const auto moved = motion(last->second, stamp)) {
      fired = moved->begin_from_end.translation().norm() >= options_.distance ||
              rotationAngle(moved->begin_from_end) >= options_.angle;
    } else {
      fired = elapsed >= options_.period_without_odometry;
    }
  }
  if (fired) last->second = stamp;
  return fired;
}

}  // namespace omnimapper::mapper
