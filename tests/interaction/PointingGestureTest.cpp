#include <gtest/gtest.h>
#include <omnimapper/interaction/PointingGesture.h>

#include <cmath>
#include <functional>
#include <random>
#include <set>

namespace omnimapper::interaction::pointing_gesture_test {
namespace {

using Eigen::Vector3d;

// A person whose right forearm is raised by this angle [rad] from hanging straight down, ahead along x.
TrackedBody withForearm(double angle, const Vector3d& shift = Vector3d::Zero()) {
  TrackedBody body;
  const Vector3d elbow(0, -0.2, 1.1);
  body.head = BodyJoint{Vector3d(0, 0, 1.6) + shift, false};
  body.torso = BodyJoint{Vector3d(0, 0, 1.1) + shift, false};
  body.right.elbow = BodyJoint{elbow + shift, false};
  body.right.hand = BodyJoint{elbow + 0.3 * Vector3d(std::sin(angle), 0, -std::cos(angle)) + shift, false};
  body.left.elbow = BodyJoint{Vector3d(0, 0.2, 1.1) + shift, false};
  body.left.hand = BodyJoint{Vector3d(0, 0.2, 0.8) + shift, false};
  return body;
}

base::Stamp at(double seconds) {
  return base::stampFromUnix(1.6e9 + seconds);
}

// The number of frames at 10 Hz that point.
int pointingFrames(const std::function<TrackedBody(int)>& body, int frames, const GestureOptions& options = {}) {
  GestureWatch watch(options);
  int count = 0;
  for (int k = 0; k < frames; ++k) count += !watch.add(at(0.1 * k), body(k)).empty();
  return count;
}

TEST(GestureWatch, aForearmPointsFrom45DegreesOn) {
  EXPECT_EQ(pointingFrames([](int) { return withForearm(44 * M_PI / 180); }, 30), 0);
  EXPECT_EQ(pointingFrames([](int) { return withForearm(46 * M_PI / 180); }, 30), 25) << "after half a second";
  EXPECT_GT(pointingFrames([](int) { return withForearm(150 * M_PI / 180); }, 30), 0) << "upwards";
}

TEST(GestureWatch, anArmThatMovesDoesNotPoint) {
  // 0.3 m/s: 0.15 m in half a second, 0.075 m from the mean; and twice that.
  EXPECT_GT(pointingFrames([](int k) { return withForearm(1.5, {0.03 * k, 0, 0}); }, 30), 0);
  EXPECT_EQ(pointingFrames([](int k) { return withForearm(1.5, {0.06 * k, 0, 0}); }, 30), 0);
}

TEST(GestureWatch, theJointsAreMeansOverTheTimeThatWasHeldStill) {
  GestureWatch watch({});
  std::mt19937_64 random(4);
  std::normal_distribution<double> noise(0, 0.01);
  std::vector<PointingGesture> found;
  for (int k = 0; k <= 5; ++k)
    found = watch.add(at(0.1 * k), withForearm(1.5, {noise(random), noise(random), noise(random)}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_right_arm);
  EXPECT_EQ(found[0].frames, 6);
  EXPECT_EQ(found[0].begin, at(0));
  EXPECT_EQ(found[0].end, at(0.5));
  EXPECT_LT((found[0].hand - withForearm(1.5).right.hand->at).norm(), 0.015);
}

TEST(GestureWatch, eachHoldingStillHasANumber) {
  GestureWatch watch({});
  std::set<int> holds;
  for (int k = 0; k < 60; ++k)
    for (const auto& gesture : watch.add(at(0.1 * k), withForearm(k / 20 == 1 ? 0.2 : 1.5))) holds.insert(gesture.hold);
  EXPECT_EQ(holds, (std::set<int>{1, 2}));
}

TEST(GestureWatch, aGapOrAClockThatJumpsBackBeginsAnew) {
  GestureWatch watch({});
  for (int k = 0; k < 10; ++k) watch.add(at(0.1 * k), withForearm(1.5));
  EXPECT_TRUE(watch.add(at(3), withForearm(1.5)).empty());
  EXPECT_TRUE(watch.add(at(0.5), withForearm(1.5)).empty());
  EXPECT_TRUE(watch.add(at(0.5), withForearm(1.5)).empty());
}

TEST(GestureWatch, guessedJointsAreNotUsed) {
  const auto with = [](bool hand, bool elbow, bool head) {
    TrackedBody body = withForearm(2.2);
    body.head->at.z() = 1.45;  // of somebody who sits
    body.right.hand->is_guessed = hand;
    body.right.elbow->is_guessed = elbow;
    body.head->is_guessed = head;
    GestureWatch watch({});
    std::vector<PointingGesture> found;
    for (int k = 0; k < 10; ++k) found = watch.add(at(0.1 * k), body);
    return found;
  };
  EXPECT_TRUE(with(true, false, false).empty());
  EXPECT_TRUE(with(false, true, true).empty());
  ASSERT_EQ(with(false, true, false).size(), 1u);
  EXPECT_FALSE(with(false, true, false)[0].elbow);
  EXPECT_FALSE(with(false, false, true)[0].head);
}

TEST(GestureWatch, bothArmsMayPoint) {
  GestureWatch watch({});
  TrackedBody body = withForearm(1.5);
  body.left.hand = BodyJoint{Vector3d(0.3, 0.2, 1.1), false};
  std::vector<PointingGesture> found;
  for (int k = 0; k < 10; ++k) found = watch.add(at(0.1 * k), body);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NE(found[0].is_right_arm, found[1].is_right_arm);
}

}  // namespace
}  // namespace omnimapper::interaction::pointing_gesture_test
