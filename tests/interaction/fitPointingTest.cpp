#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/interaction/PointingTables.h>
#include <omnimapper/interaction/fitPointing.h>

#include <algorithm>
#include <cmath>

#include "Gestures.h"

namespace omnimapper::interaction::fit_pointing_test {
namespace {

constexpr double kDegree = M_PI / 180;

// Two people with two frames each: means 0.1 and 0.3, each 0.01 to both sides.
TEST(fitPointing, momentsAreThoseWorkedByHand) {
  std::vector<PointingSample> samples;
  for (const double mean : {0.1, 0.3})
    for (const double off : {-0.01, 0.01})
      samples.push_back({mean < 0.2 ? "anna" : "ben", "cup", {0.5, -0.2}, {mean + off, -mean}, {2 * mean, off}});
  const PointingFit fit = fitPointing(samples);
  ASSERT_EQ(fit.model.rows.size(), 1u);
  const PointingRow& row = fit.model.rows[0];
  EXPECT_NEAR(row.elbow_hand.theta.mean, 0.2, 1e-12);
  EXPECT_NEAR(row.elbow_hand.theta.sigma, std::sqrt((2 * 0.11 * 0.11 + 2 * 0.09 * 0.09) / 3), 1e-12);
  EXPECT_NEAR(row.head_hand.theta.mean, 0.4, 1e-12);
  ASSERT_TRUE(row.direction);
  EXPECT_NEAR(row.direction->azimuth, 0.5, 1e-12);
  EXPECT_NEAR(row.direction->altitude, -0.2, 1e-12);
  EXPECT_EQ(fit.targets[0].people, 2u);
  EXPECT_NEAR(fit.targets[0].elbow_hand.theta.mean, std::sqrt(0.02 / 2), 1e-12) << "of two means 0.1 from theirs";
  EXPECT_NEAR(fit.targets[0].elbow_hand.theta.sigma, 0.01 * std::sqrt(2), 1e-12);
  EXPECT_NEAR(fit.model.theta_correlation, 0.08 / std::sqrt(0.0404 * 0.16), 1e-12);
}

TEST(fitPointing, whatHasNoSpreadIsRefused) {
  const PointingSample sample{"anna", "cup", {}, {0.1, 0.1}, {0.1, 0.1}};
  EXPECT_THROW(fitPointing({}), base::Error);
  EXPECT_THROW(fitPointing({sample}), base::Error);
  EXPECT_THROW(fitPointing({sample, sample}), base::Error);
}

// Six users, seven targets, thirty frames each, drawn from the tables: 180 frames a row. Frames that are drawn
// independently have means within 4 sigma / sqrt(180) and sigmas within 4 / sqrt(360).
TEST(fitPointing, recoversTheTablesFromSixUsersAndSevenTargets) {
  std::vector<PointingSample> samples;
  for (int target = 1; target <= 7; ++target) {
    DrawnErrors errors(thesisRow(SkeletonSoftware::openni, target), static_cast<unsigned>(target));
    for (int user = 0; user < 6; ++user)
      for (int frame = 0; frame < 30; ++frame)
        samples.push_back({std::to_string(user),
                           "target " + std::to_string(target),
                           {0.2 * target, -0.3},
                           errors.elbowHand(),
                           errors.headHand()});
  }
  const PointingFit fit = fitPointing(samples);
  ASSERT_EQ(fit.model.rows.size(), 7u);
  for (int target = 1; target <= 7; ++target) {
    const PointingRow& found = fit.model.rows[static_cast<std::size_t>(target - 1)];
    const PointingRow truth = thesisRow(SkeletonSoftware::openni, target);
    for (const auto ray : {&PointingRow::elbow_hand, &PointingRow::head_hand}) {
      for (const auto angle : {&RayErrors::theta, &RayErrors::psi}) {
        const AngleError &is = found.*ray.*angle, &was = truth.*ray.*angle;
        EXPECT_NEAR(is.mean, was.mean, std::max(1 * kDegree, 4 * was.sigma / std::sqrt(180.0))) << target;
        EXPECT_NEAR(is.sigma / was.sigma, 1, 0.15) << target;
      }
    }
  }
  EXPECT_LT(std::abs(fit.model.theta_correlation), 0.1);
}

}  // namespace
}  // namespace omnimapper::interaction::fit_pointing_test
