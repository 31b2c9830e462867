#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/LogVariants.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <cmath>

#include "laser2d/BrokenMotion.h"

// What nobody measured: the base is carried while nothing is recorded; the clock of the wheels is another than the
// laser's.
namespace omnimapper::plugins::carried_test {
namespace {

using testing::SimulatedLog;

SimulatedLog ring(double laps) {
  testing::SimulatedLogOptions options;
  options.laps = laps;
  return SimulatedLog(options);
}

std::vector<mapper::Evidence> evidenceOf(const mapper::View& view, const std::string& name) {
  std::vector<mapper::Evidence> found;
  std::copy_if(view.verdict.evidence.begin(), view.verdict.evidence.end(), std::back_inserter(found),
               [&](const auto& one) { return one.name == name; });
  return found;
}

base::Stamp later(const SimulatedLog& log, double seconds) {
  return log.begin() + base::durationFromSeconds(seconds);
}

TEST(Carried, AcrossAGapIsToldToTheSecondOrFoundOut) {
  const auto log = ring(1.6);
  for (const double metres : testing::kIsSanitized ? std::vector<double>{4} : std::vector<double>{2, 4, 8}) {
    constexpr double kSpeed = 0.7;  // [m/s] of the simulated robot
    const double from = 20, to = from + metres / kSpeed;
    const auto engine = testing::makeEngine(testing::kLaserIni);
    testing::run(*engine, testing::carried(log.observations(), later(log, from), later(log, to), 5));
    const auto view = engine->view();
    const auto broken = evidenceOf(view, kBrokenAfter);
    ASSERT_EQ(broken.size(), 1U) << metres;
    EXPECT_NEAR(broken[0].value, from, 1.5) << metres;
    // Where the base is right, to a decimetre, relative to where it was before the gap.
    const auto& last = view.map.key_frames.back();
    const auto before = std::find_if(view.map.key_frames.begin(), view.map.key_frames.end(),
                                     [&](const auto& frame) { return frame.stamp >= later(log, from - 2); });
    const auto moved_stamp = last.stamp + (later(log, to) - later(log, from + 5));
    const auto truth = log.truthAt(moved_stamp) - log.truthAt(before->stamp);
    const auto error = mrpt::poses::CPose2D(last.map_from_base - before->map_from_base) - truth;
    const bool is_right = error.norm() < 0.5;
    EXPECT_TRUE(is_right || broken[0].says == mapper::Evidence::Says::against_it) << metres << ": " << error;
  }
}

TEST(Carried, ARobotThatStandsOrDrivesDuringAGapIsNotSuspected) {
  const auto log = ring(1.6);
  for (const double seconds : testing::kIsSanitized ? std::vector<double>{3} : std::vector<double>{3, 10}) {
    const auto standing = testing::makeEngine(testing::kLaserIni);
    testing::run(*standing, testing::carried(log.observations(), later(log, 20), later(log, 20), seconds));
    EXPECT_TRUE(evidenceOf(standing->view(), kBrokenAfter).empty()) << seconds;
    auto observations = log.observations();
    observations.erase(std::remove_if(observations.begin(), observations.end(),
                                      [&](const auto& one) {
                                        return one->timestamp > later(log, 20) &&
                                               one->timestamp < later(log, 20 + seconds);
                                      }),
                       observations.end());
    const auto driving = testing::makeEngine(testing::kLaserIni);
    testing::run(*driving, observations);
    EXPECT_TRUE(evidenceOf(driving->view(), kBrokenAfter).empty()) << seconds;
  }
}

TEST(Carried, TheClockOfTheWheelsIsSetRight) {
  const auto log = ring(2);
  for (const double offset : testing::kIsSanitized ? std::vector<double>{-0.2} : std::vector<double>{0, -0.2, 0.2}) {
    auto observations = log.observations();
    for (const auto& one : observations) {
      if (dynamic_cast<const mrpt::obs::CObservationOdometry*>(one.get()))
        one->timestamp += base::durationFromSeconds(offset);
    }
    std::stable_sort(observations.begin(), observations.end(),
                     [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
    const auto engine = testing::makeEngine(testing::kLaserIni);
    testing::run(*engine, observations);
    const auto told = evidenceOf(engine->view(), "odometry_clock_offset_s");
    ASSERT_EQ(told.size(), offset == 0 ? 0U : 1U) << offset;
    if (offset == 0) continue;
    EXPECT_NEAR(told[0].value, offset, 0.04);
  }
}

}  // namespace
}  // namespace omnimapper::plugins::carried_test
