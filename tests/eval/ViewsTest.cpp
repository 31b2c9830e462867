#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <functional>
#include <utility>

#include "omnimapper/eval/TumFile.h"
#include "omnimapper/eval/ViewAgreement.h"
#include "omnimapper/eval/Views.h"

namespace omnimapper::eval::views_test {

namespace {

using testing::sourceFile;

LogViews readHome(const Trajectory& trajectory, ViewOptions options = {},
                  const std::string& log = "rawlogs/home_30s/home_30s.rawlog") {
  options.longest_gap = base::durationFromSeconds(0.06);
  base::Progress silent;
  return readViews(sourceFile(log), trajectory, options, silent, [] { return false; });
}

Trajectory homePoses() {
  return readTum(sourceFile("rawlogs/home_30s/truth.tum"));
}

std::string messageOf(const std::function<void()>& what, base::ExitCode code) {
  try {
    what();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace

TEST(Views, ShowTheFloorOfASimulatedHomeWhereItIs) {
  ViewOptions options;
  options.most_views = 10;
  const auto read = readHome(homePoses(), options);
  EXPECT_EQ(read.code, base::ExitCode::ok);
  EXPECT_EQ(read.posed, read.images);
  EXPECT_GT(read.images, 10U);
  EXPECT_LE(read.views.size(), 10U);
  EXPECT_GT(read.views.size(), 4U) << "not thinned by more than half";
  const auto agreement = judgeByViews({}, read.views);
  ASSERT_FALSE(agreement.levels.empty());
  const auto& floor = agreement.seen[agreement.levels.front().merged_surface].surface;
  EXPECT_NEAR(floor.plane.normal.z(), 1, 1e-3);
  EXPECT_NEAR(floor.plane.distance, 0, 0.02);
  EXPECT_GT(agreement.points, 1000U);
}

TEST(Views, CountNothingThatIsFarAway) {
  ViewOptions options;
  options.most_views = 10;
  options.max_range = 1.5;
  const auto poses = homePoses();
  const auto read = readHome(poses, options);
  for (const auto& view : read.views) {
    for (const auto& plane : view.planes) {
      ASSERT_TRUE(plane.surface.seen);
      for (const auto& point : plane.points) {
        double least = 1e300;
        for (const auto& pose : poses) least = std::min(least, (point - pose.world_from_body.translation).norm());
        EXPECT_LT(least, 3.5) << "the camera is on the robot";
      }
    }
  }
  EXPECT_LT(judgeByViews({}, read.views).area.seen, judgeByViews({}, readHome(poses).views).area.seen);
}

TEST(Views, OfPosesOutsideOfTheLogThereAreNone) {
  Trajectory others = homePoses();
  for (auto& pose : others) pose.stamp += std::chrono::hours(24);
  const auto message = messageOf([&] { readHome(others); }, base::ExitCode::unreadable_input);
  EXPECT_NE(message.find("no depth image has a pose"), std::string::npos) << message;
  messageOf([] { readHome({}); }, base::ExitCode::unreadable_input);
}

TEST(Views, OfALogWithoutDepthImagesThereAreNone) {
  const auto message =
      messageOf([] { readHome(homePoses(), {}, "rawlogs/box/box.rawlog"); }, base::ExitCode::unreadable_input);
  EXPECT_NE(message.find("holds no depth image"), std::string::npos) << message;
}

TEST(Views, StopWhenStopReturnsTrue) {
  base::Progress silent;
  bool asked = false;
  const auto stop = [&] { return std::exchange(asked, true); };
  messageOf([&] { readViews(sourceFile("rawlogs/home_30s/home_30s.rawlog"), homePoses(), {}, silent, stop); },
            base::ExitCode::interrupted);
  EXPECT_TRUE(asked);
}

}  // namespace omnimapper::eval::views_test
