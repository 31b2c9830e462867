#include <gtest/gtest.h>
#include <omnimapper/drivers/FramePairing.h>
#include <omnimapper/drivers/TickClock.h>

#include "../live/Observations.h"

namespace omnimapper::drivers::kinect_time_test {
namespace {

using live::observations::at;

constexpr double kTicks = 60e6;  // in a second

std::uint32_t ticks(double seconds) {
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(std::llround(seconds * kTicks)));
}

TEST(TickClock, differencesAreTheDevicesAndTheLatencyIsTheShortest) {
  TickClock clock;
  const double latencies[] = {0.030, 0.012, 0.040, 0.015, 0.090, 0.020};
  std::vector<TickClock::Time> times;
  for (int i = 0; i < 6; ++i) times.push_back(clock.at(ticks(50 + i / 30.0), at(i / 30.0 + latencies[i])));
  EXPECT_NEAR(base::secondsBetween(at(0), times[0].stamp), 0.030, 1e-5) << "the first one has only its own latency";
  for (int i = 1; i < 6; ++i) {
    EXPECT_NEAR(base::secondsBetween(at(i / 30.0), times[i].stamp), 0.012, 1e-4) << i;
    EXPECT_NEAR(times[i].seconds, i / 30.0, 1e-7) << i;
  }
}

TEST(TickClock, ticksBeginAnewEvery71Seconds) {
  TickClock clock;
  const double round = 4294967296 / kTicks;
  for (const double seconds : {0.0, 0.5, 1.0, 60.0, 60.0 + round, 61.0 + 3 * round})
    EXPECT_NEAR(clock.at(ticks(round - 0.7 + seconds), at(seconds + 0.01)).seconds, seconds, 1e-6) << seconds;
}

TEST(TickClock, aPictureMayComeAfterADepthImageThatIsYounger) {
  TickClock clock;
  clock.at(ticks(10), at(0));
  EXPECT_NEAR(clock.at(ticks(9.99), at(0.001)).seconds, -0.01, 1e-6);
  EXPECT_NEAR(clock.at(ticks(10.02), at(0.02)).seconds, 0.02, 1e-6);
}

TEST(TickClock, aClockThatGoesBackIsTakenUpWhereItIs) {
  TickClock clock;
  clock.at(ticks(10), at(0));
  clock.at(ticks(12), at(2));
  const auto back = clock.at(ticks(10), at(2.05));
  EXPECT_NEAR(back.seconds, 2.05, 1e-6);
  EXPECT_NEAR(base::secondsBetween(at(2.05), back.stamp), 0, 1e-6);
  EXPECT_NEAR(base::secondsBetween(at(2.15), clock.at(ticks(10.1), at(2.17)).stamp), 0, 1e-4);
}

TEST(TickClock, aHostThatIsHeldUpMovesNoStamp) {
  TickClock clock;
  clock.at(ticks(10), at(0));
  EXPECT_NEAR(base::secondsBetween(at(0.1), clock.at(ticks(10.1), at(1.5)).stamp), 0, 1e-3);
  EXPECT_NEAR(base::secondsBetween(at(1.5), clock.at(ticks(11.5), at(1.5)).stamp), 0, 1e-3);
}

KinectFrame depthsAt(double seconds) {
  return {seconds, at(seconds), {1}, {}};
}
// The picture that a frame got, or -1.
int pictureOf(const std::optional<KinectFrame>& frame) {
  return frame && !frame->picture.empty() ? frame->picture[0] : -1;
}

TEST(FramePairing, theNearestPictureIsTaken) {
  FramePairing pairing(0.02);
  pairing.addPicture(0.99, {1});
  pairing.add(depthsAt(1));
  EXPECT_FALSE(pairing.take(false)) << "a nearer one may come";
  pairing.addPicture(1.005, {2});
  EXPECT_EQ(pictureOf(pairing.take(false)), 2);
  EXPECT_FALSE(pairing.take(true));
  pairing.add(depthsAt(1.033));
  pairing.addPicture(1.04, {3});
  EXPECT_EQ(pictureOf(pairing.take(false)), 3);
}

TEST(FramePairing, whatIsTooFarInTimeIsNoPicture) {
  FramePairing pairing(0.02);
  pairing.addPicture(0.9, {1});
  pairing.add(depthsAt(1));
  pairing.addPicture(1.03, {2});
  const auto frame = pairing.take(false);
  ASSERT_TRUE(frame);
  EXPECT_EQ(pictureOf(frame), -1);
  EXPECT_EQ(frame->seconds, 1);
  pairing.add(depthsAt(1.033));
  EXPECT_EQ(pictureOf(pairing.take(true)), 2) << "it is kept for the next";
}

TEST(FramePairing, aLaterDepthImageEndsTheWaiting) {
  FramePairing pairing(0.02);
  pairing.add(depthsAt(1));
  EXPECT_FALSE(pairing.take(false));
  pairing.add(depthsAt(1.033));
  const auto frame = pairing.take(false);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->seconds, 1);
  EXPECT_FALSE(pairing.take(false));
}

}  // namespace
}  // namespace omnimapper::drivers::kinect_time_test
