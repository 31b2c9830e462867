#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/AbsoluteTrajectoryError.h>
#include <omnimapper/eval/FixedOffset.h>

#include "Trajectories.h"

namespace omnimapper::eval::fixed_offset_test {
namespace {

constexpr double kDegree = geometry::kPi / 180;

// An S of 12 m that is driven in 20 s, ten poses a second.
Trajectory drive(double first_second) {
  Trajectory poses;
  for (int i = 0; i < 200; ++i) {
    const double t = first_second + 0.1 * i, yaw = 1.5 * std::sin(0.4 * t);
    poses.push_back({at(t), geometry::lift({0.6 * t, 2 * std::cos(0.3 * t), yaw})});
  }
  return poses;
}

TEST(FixedOffset, OfAPartAndAClockIsFound) {
  // The reference is of a part 0.2 m ahead, 0.1 m to the right and turned by 50 deg, in another world, 0.03 s ahead.
  const geometry::Se3 part = geometry::lift({0.2, -0.1, 50 * kDegree});
  const geometry::Se3 world = geometry::lift({3, -4, 130 * kDegree});
  Trajectory reference = trajectoryOfPart(drive(0), part);
  for (auto& pose : reference) {
    pose.world_from_body = world * pose.world_from_body;
    pose.stamp += base::durationFromSeconds(0.03);
  }
  const auto longest_gap = base::durationFromSeconds(0.2);
  const auto found = fitFixedOffset(drive(0), reference, longest_gap);
  EXPECT_NEAR(found.body_from_part.translation.x(), 0.2, 2e-3);
  EXPECT_NEAR(found.body_from_part.translation.y(), -0.1, 2e-3);
  EXPECT_NEAR(geometry::project(found.body_from_part).yaw, 50 * kDegree, 2e-3);
  EXPECT_NEAR(found.body_from_part.translation.z(), 0, 1e-3) << "is not determined";
  EXPECT_NEAR(found.clock, 0.03, 1e-3);
  PairingOptions options;
  options.alignment = Alignment::se3;
  options.longest_gap = longest_gap;
  EXPECT_LT(absoluteTrajectoryError(withOffset(drive(0), found), reference, options).translation.rmse, 1e-3);
  EXPECT_GT(absoluteTrajectoryError(drive(0), reference, options).translation.rmse, 0.02);
  EXPECT_NE(describe(found).find("0.0300 s ahead"), std::string::npos) << describe(found);
}

TEST(FixedOffset, ClocksAtWhichFewPosesHaveAReferenceAreNotBetter) {
  // The estimate has an error of 5 cm that no offset explains; the reference is shorter and has a gap of 4 s.
  Trajectory estimate = drive(0), reference;
  for (std::size_t i = 0; i < estimate.size(); ++i)
    estimate[i].world_from_body.translation.x() += i % 2 == 0 ? 0.05 : -0.05;
  for (std::size_t i = 0; i < 160; ++i)
    if (i < 60 || i >= 100) reference.push_back(drive(0)[i]);
  const auto found = fitFixedOffset(estimate, reference, base::durationFromSeconds(0.2));
  EXPECT_LT(std::abs(found.clock), 0.05);
  EXPECT_LT(found.body_from_part.translation.norm(), 0.05);
}

TEST(FixedOffset, NeedsPosesWithinTheReference) {
  EXPECT_THROW(fitFixedOffset(drive(0), drive(100), base::durationFromSeconds(0.2)), base::Error);
}

}  // namespace
}  // namespace omnimapper::eval::fixed_offset_test
