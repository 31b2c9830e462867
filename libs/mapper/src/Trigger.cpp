#include <omnimapper/mapper/Trigger.h>

#include <cmath>

namespace omnimapper::mapper {

const base::OptionTable<TriggerOptions>& TriggerOptions::table() {
  using Options = TriggerOptions;
  static const auto table =
      base::OptionTable<Options>()
          .flag("every_observation", &Options::every_observation, "Every observation becomes a key frame.")
          .number("distance_m", &Options::distance, base::Range::positive(), "A key frame after this way, by odometry.")
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

bool Trigger::isDue(const Since& since) const {
  const double elapsed = base::secondsBetween(since.fired, since.seen);
  if (options_.every_observation || (options_.period > 0 && elapsed >= options_.period)) return true;
  if (!since.motion) return elapsed >= options_.period_without_odometry;
  return since.motion->translation().norm() >= options_.distance || rotationAngle(*since.motion) >= options_.angle;
}

bool Trigger::fires(const std::string& label, base::Stamp stamp, const MotionBetween& motion) {
  const auto [entry, first] = labels_.try_emplace(label, Since{stamp, stamp, mrpt::poses::CPose3D()});
  if (first) return true;
  Since& since = entry->second;
  // Motion is summed step by step: asking for all of it each time would cost ever more while the robot rests.
  const auto step = motion(since.seen, stamp);
  since.motion = step && since.motion ? std::make_optional(*since.motion + step->begin_from_end) : std::nullopt;
  since.seen = stamp;
  if (!isDue(since)) return false;
  since = {stamp, stamp, mrpt::poses::CPose3D()};
  return true;
}

}  // namespace omnimapper::mapper
