#include <gtest/gtest.h>

#include "RenderedRoom.h"

namespace omnimapper::matching::rgbd_tracker_test {
namespace {

using geometry::Se3;
using How = RgbdTracker::Tracked::How;

base::Stamp at(double seconds) {
  return base::stampFromUnix(1.6e9) + base::durationFromSeconds(seconds);
}

/// A camera that moves to and fro, back at the start after 2 pi seconds.
Se3 swing(double seconds) {
  geometry::Vector6d delta;
  delta << 0.2 * std::sin(seconds), 0.05 * std::sin(2 * seconds), 0.1 * (1 - std::cos(seconds)),
      0.1 * std::sin(2 * seconds), 0.5 * std::sin(seconds), 0.1 * std::sin(seconds);
  return geometry::plus(Se3{}, delta);
}

/// Options without a rolling shutter, because all rows of the room are rendered at once.
RgbdTrackerOptions atOnce() {
  RgbdTrackerOptions options;
  options.depth_readout = options.picture_readout = options.picture_delay = options.picture_delay_sigma = 0;
  return options;
}

class Camera {
 public:
  explicit Camera(const RgbdTrackerOptions& options = atOnce(), unsigned tiles = 0) : tracker_(options, {}) {
    room_.tiles = tiles;
  }

  RgbdTracker::Tracked add(double seconds, const Se3& pose, bool is_covered = false) {
    auto image = room_.render(pose);
    if (is_covered) {
      std::fill(image.depth.begin(), image.depth.end(), 0.0F);
      std::fill(image.grey.begin(), image.grey.end(), std::uint8_t{3});
    }
    return tracker_.track(at(seconds), room_.pyramid(image));
  }
  std::size_t keyFrames() const { return tracker_.keyFrames(); }

 private:
  RenderedRoom room_;
  RgbdTracker tracker_;
};

TEST(RgbdTracker, FollowsTheCameraAndTakesOldKeyFramesOnTheWayBack) {
  Camera run;
  std::size_t halfway = 0;
  double farthest = 0;
  for (int i = 0; i <= 62; ++i) {
    const double seconds = 0.1 * i;
    const auto tracked = run.add(seconds, swing(seconds));
    EXPECT_EQ(tracked.how, i == 0 ? How::begun : How::tracked) << i;
    const geometry::Vector6d off = minus(tracked.map_from_camera, inverse(swing(0)) * swing(seconds));
    farthest = std::max(farthest, off.head<3>().norm());
    EXPECT_LT(off.tail<3>().norm(), 0.01) << i;
    if (i == 16) halfway = run.keyFrames();
  }
  EXPECT_LT(farthest, 0.015);
  EXPECT_GT(halfway, 3U);
  EXPECT_LT(run.keyFrames(), 4 * halfway) << "the same views need no more key frames";
}

TEST(RgbdTracker, ACoveredLensIsReportedAndTheViewFoundAgain) {
  Camera run;
  for (int i = 0; i < 5; ++i) run.add(0.1 * i, swing(0.1 * i));
  run.add(0.5, swing(0.5));
  for (int i = 6; i < 10; ++i) EXPECT_EQ(run.add(0.1 * i, swing(0.5), true).how, How::lost) << i;
  const auto after = run.add(1.0, swing(0.3));
  EXPECT_EQ(after.how, How::found);
  EXPECT_EQ(after.last, at(0.5)) << "the motion is that across the gap";
  const Se3 truth = inverse(swing(0.5)) * swing(0.3);
  EXPECT_LT(minus(after.last_from_camera, truth).head<3>().norm(), 0.01);
  EXPECT_EQ(run.add(1.1, swing(0.4)).how, How::tracked);
}

/// A pose that is turned about the vertical, and moved a little with it.
Se3 turned(double angle) {
  return posed(0.1 * angle, 0, 0, 0, angle, 0);
}

TEST(RgbdTracker, CornersDetermineAMotionThatIsNotExpected) {
  for (const bool use_features : {true, false}) {
    auto options = atOnce();
    options.use_features = use_features;
    Camera run(options, 1);
    // The camera turns to the right as fast as it can, then 25 deg to the left within one image.
    const double angles[] = {0, 0.15, 0.3, 0.45, 0};
    RgbdTracker::Tracked last;
    for (int i = 0; i < 5; ++i) last = run.add(0.15 * i, turned(angles[i]));
    const double off = minus(last.map_from_camera, inverse(turned(0)) * turned(0)).norm();
    if (use_features) {
      EXPECT_EQ(last.how, How::tracked);
      EXPECT_LT(off, 0.02);
    } else {
      EXPECT_TRUE(last.how != How::tracked || off > 0.02) << "then corners would not be needed for it";
    }
  }
}

TEST(RgbdTracker, ALostCameraIsFoundByCornersFarFromAllKeyFrames) {
  Camera run(atOnce(), 1);
  run.add(0, turned(0));
  run.add(0.1, turned(0.02));
  EXPECT_EQ(run.add(0.2, turned(0.02), true).how, How::lost);
  const auto after = run.add(0.4, turned(0.45));
  EXPECT_EQ(after.how, How::found);
  EXPECT_LT(minus(after.map_from_camera, inverse(turned(0)) * turned(0.45)).norm(), 0.02);
}

TEST(RgbdTracker, AfterALongLossItBeginsAnewWithoutAMotion) {
  Camera run;
  run.add(0, swing(0));
  for (int i = 1; i <= 19; ++i) EXPECT_EQ(run.add(0.1 * i, swing(0), true).how, How::lost);
  geometry::Vector6d away;
  away << 0, 0, 0, 0, 2.5, 0;
  const Se3 elsewhere = geometry::plus(Se3{}, away);
  EXPECT_EQ(run.add(2.5, elsewhere).how, How::begun);
  EXPECT_EQ(run.add(2.6, elsewhere).how, How::tracked);
  EXPECT_EQ(run.keyFrames(), 1U) << "the poses of the old ones relative to this image are not known";
}

TEST(RgbdTracker, TheSameImagesGiveTheSameBits) {
  Camera a, b;
  for (int i = 0; i < 8; ++i) {
    const auto one = a.add(0.1 * i, swing(0.1 * i)), other = b.add(0.1 * i, swing(0.1 * i));
    EXPECT_EQ(one.map_from_camera.translation, other.map_from_camera.translation);
    EXPECT_EQ(one.map_from_camera.rotation.coeffs(), other.map_from_camera.rotation.coeffs());
    EXPECT_EQ(one.match.covariance, other.match.covariance);
  }
}

TEST(RgbdTracker, KeepsAsManyKeyFramesAsAsked) {
  auto options = atOnce();
  options.key_frames = 3;
  Camera run(options);
  for (int i = 0; i < 16; ++i) run.add(0.1 * i, swing(0.1 * i));
  EXPECT_EQ(run.keyFrames(), 3U);
}

}  // namespace
}  // namespace omnimapper::matching::rgbd_tracker_test
