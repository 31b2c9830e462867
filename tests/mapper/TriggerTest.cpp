#include <gtest/gtest.h>
#include <omnimapper/mapper/Trigger.h>
#include <omnimapper/motion/PoseTimeline.h>

#include <vector>

namespace omnimapper::mapper::trigger_test {
namespace {

using mrpt::poses::CPose3D;

constexpr double kDegree = base::option_text::kRadiansPerDegree;

base::Stamp at(double seconds) {
  return base::stampFromUnix(1'000'000'000) + base::durationFromSeconds(seconds);
}

TriggerOptions halfMetreOr30Degrees() {
  TriggerOptions options;
  options.distance = 0.5;
  options.angle = 30 * kDegree;
  options.period_without_odometry = 1;
  return options;
}

// A timeline with the interface that the engine uses.
Trigger::MotionBetween asked(const motion::PoseTimeline& timeline) {
  return [&timeline](base::Stamp begin, base::Stamp end) { return timeline.between(begin, end); };
}

motion::PoseTimeline even(double seconds, const CPose3D& motion_per_second) {
  motion::PoseTimeline timeline;
  for (double t = 0; t < seconds; t += 1) {
    timeline.insert(at(t), at(t + 1), {motion_per_second, Eigen::Matrix<double, 6, 6>::Zero()});
  }
  return timeline;
}

std::vector<double> firings(Trigger& trigger, double step, int count, const Trigger::MotionBetween& motion) {
  std::vector<double> fired;
  for (int i = 0; i < count; ++i) {
    if (trigger.fires("laser", at(step * i), motion)) fired.push_back(step * i);
  }
  return fired;
}

TEST(Trigger, FiresAtTheFirstObservationThatReachesTheDistance) {
  const auto timeline = even(10, CPose3D(0.2, 0, 0, 0, 0, 0));
  Trigger trigger(halfMetreOr30Degrees());
  // At 0.2 m/s, 0.5 m are reached after 2.5 s, and the next observation is at 3 s.
  EXPECT_EQ(firings(trigger, 1, 10, asked(timeline)), (std::vector<double>{0, 3, 6, 9}));
}

TEST(Trigger, FiresAtTheAngle) {
  const auto timeline = even(10, CPose3D(0, 0, 0, 12 * kDegree, 0, 0));
  Trigger trigger(halfMetreOr30Degrees());
  EXPECT_EQ(firings(trigger, 1, 10, asked(timeline)), (std::vector<double>{0, 3, 6, 9}));
}

TEST(Trigger, CountsTheDistanceFromTheLastKeyFrameNotTheDistanceTravelled) {
  motion::PoseTimeline timeline;  // to and fro by 0.3 m
  for (int i = 0; i < 10; ++i) {
    timeline.insert(at(i), at(i + 1),
                    {CPose3D(i % 2 ? -0.3 : 0.3, 0, 0, 0, 0, 0), Eigen::Matrix<double, 6, 6>::Zero()});
  }
  Trigger trigger(halfMetreOr30Degrees());
  EXPECT_EQ(firings(trigger, 1, 10, asked(timeline)), (std::vector<double>{0}));
}

TEST(Trigger, TimeAloneFiresOnlyWherePeriodIsSet) {
  const auto timeline = even(20, CPose3D());
  auto options = halfMetreOr30Degrees();
  Trigger at_rest(options);
  EXPECT_EQ(firings(at_rest, 1, 12, asked(timeline)), (std::vector<double>{0}));
  options.period = 4;
  Trigger periodic(options);
  EXPECT_EQ(firings(periodic, 1, 12, asked(timeline)), (std::vector<double>{0, 4, 8}));
}

TEST(Trigger, EveryObservationFiresWhereTheUserSaysSo) {
  auto options = halfMetreOr30Degrees();
  options.every_observation = true;
  Trigger trigger(options);
  const auto timeline = even(5, CPose3D());
  EXPECT_EQ(firings(trigger, 0.5, 4, asked(timeline)), (std::vector<double>{0, 0.5, 1, 1.5}));
}

TEST(Trigger, EachLabelHasItsOwnState) {
  const auto timeline = even(10, CPose3D(0.2, 0, 0, 0, 0, 0));
  Trigger trigger(halfMetreOr30Degrees());
  const auto motion = asked(timeline);
  EXPECT_TRUE(trigger.fires("front", at(0), motion));
  EXPECT_FALSE(trigger.fires("front", at(1), motion));
  EXPECT_TRUE(trigger.fires("rear", at(1.5), motion)) << "the first of its label";
  EXPECT_FALSE(trigger.fires("front", at(2), motion));
  EXPECT_TRUE(trigger.fires("front", at(2.6), motion)) << "0.52 m since its own key frame";
  EXPECT_FALSE(trigger.fires("rear", at(3), motion)) << "0.3 m since its own key frame";
  EXPECT_TRUE(trigger.fires("rear", at(4), motion)) << "0.5 m since its own key frame";
}

TEST(Trigger, WhereNoOdometryMeasuresTheMotionTimeFiresUntilItIsBack) {
  motion::PoseTimeline timeline;  // no motion between 2 s and 6 s
  timeline.insert(at(0), at(2), motion::identityMotion());
  timeline.insert(at(6), at(20), motion::identityMotion());
  Trigger trigger(halfMetreOr30Degrees());
  const auto fired = firings(trigger, 0.5, 30, asked(timeline));
  // From 2.5 s on a part of the span since the key frame at 0 s is uncovered, and more than a second has passed; after
  // that there is a key frame every second. The key frame at 6.5 s follows the last uncovered step (5.5 s to 6 s); from
  // then on the robot is known to rest.
  EXPECT_EQ(fired, (std::vector<double>{0, 2.5, 3.5, 4.5, 5.5, 6.5}));
}

TEST(Trigger, AsksForEachStretchOfMotionOnce) {
  Trigger trigger(halfMetreOr30Degrees());
  double asked_seconds = 0;
  int calls = 0;
  base::Stamp asked_until = at(0);
  const auto motion = [&](base::Stamp begin, base::Stamp end) -> std::optional<RelativeMotion> {
    EXPECT_EQ(begin, asked_until);
    asked_until = end;
    asked_seconds += base::secondsBetween(begin, end);
    ++calls;
    return motion::identityMotion();
  };
  constexpr int kCount = 10000;
  for (int i = 0; i < kCount; ++i) trigger.fires("laser", at(0.1 * i), motion);
  EXPECT_EQ(calls, kCount - 1);
  EXPECT_NEAR(asked_seconds, 0.1 * (kCount - 1), 1e-6) << "hours of rest must not cost ever more";
}

}  // namespace
}  // namespace omnimapper::mapper::trigger_test
