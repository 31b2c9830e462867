#include <gtest/gtest.h>
#include <omnimapper/matching/ScanMatcherOptions.h>

#include <Eigen/Eigenvalues>

#include "Scans.h"

namespace omnimapper::matching::scan_matchers_test {
namespace {

using mrpt::math::TPose2D;
using testing::FloorPlan;

constexpr double kDegree = 3.14159265358979323846 / 180;

// Places of the ring, each with the true motion from the reference to the scan.
struct Place {
  TPose2D reference, motion;
};
const std::vector<Place> kPlaces{{{0, 0, 0}, {0.4, 0.05, 5 * kDegree}},
                                 {{8.4, 3, 95 * kDegree}, {0.3, -0.1, -8 * kDegree}},
                                 {{-2, 9, -3.1}, {0.5, 0, 0}},
                                 {{-8.3, 4, -90 * kDegree}, {0, 0, 20 * kDegree}}};

struct Which {
  const char* name;
  MatcherKind matcher;
  IcpMethod method;
};
std::ostream& operator<<(std::ostream& out, const Which& which) {
  return out << which.name;
}

class ScanMatchers : public ::testing::TestWithParam<Which> {
 protected:
  ScanMatch match(const ScanWithNormals& reference, const ScanWithNormals& scan, const TPose2D& guess) const {
    return matcher_->match(*matcher_->prepare(reference), scan, {guess});
  }

 private:
  std::unique_ptr<ScanMatcher> matcher_ = [] {
    ScanMatcherOptions options;
    options.matcher = GetParam().matcher;
    options.icp_method = GetParam().method;
    return makeMatcher(options);
  }();
};
INSTANTIATE_TEST_SUITE_P(All, ScanMatchers,
                         ::testing::Values(Which{"point_to_line", MatcherKind::point_to_line, {}},
                                           Which{"icp", MatcherKind::icp, IcpMethod::classic},
                                           Which{"icp_lm", MatcherKind::icp, IcpMethod::levenberg_marquardt}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(ScanMatchers, FindsAKnownMotionFromAGridOfStarts) {
  const auto plan = FloorPlan::ring();
  for (const auto& [pose, motion] : kPlaces) {
    const auto reference = scanFrom(plan, pose), scan = scanFrom(plan, pose + motion);
    for (const double dx : {-0.2, 0.0, 0.2}) {
      for (const double dy : {-0.2, 0.0, 0.2}) {
        for (const double turn : {-6 * kDegree, 0.0, 6 * kDegree}) {
          const auto found = match(reference, scan, motion + TPose2D(dx, dy, turn));
          const auto error = found.reference_from_scan - motion;
          EXPECT_LT(std::hypot(error.x, error.y), 0.01) << pose << " from " << dx << ", " << dy << ", " << turn;
          EXPECT_LT(std::abs(error.phi), 0.2 * kDegree) << pose << " from " << dx << ", " << dy << ", " << turn;
          EXPECT_GT(found.overlap, 0.7);
          EXPECT_LT(found.wall_distance, 0.03);
        }
      }
    }
  }
}

TEST_P(ScanMatchers, ErrorsOfNoisyMatchesAgreeWithTheCovarianceItReports) {
  const double sigma = 0.01;
  const auto plan = FloorPlan::ring();
  double squares = 0;
  int count = 0;
  for (const auto& [pose, motion] : kPlaces) {
    for (std::uint64_t seed = 0; seed < 15; ++seed) {
      const auto reference = scanFrom(plan, pose, sigma, 2 * seed),
                 scan = scanFrom(plan, pose + motion, sigma, 2 * seed + 1);
      const auto found = match(reference, scan, motion + TPose2D(0.05, -0.05, 2 * kDegree));
      const auto difference = found.reference_from_scan - motion;
      const Eigen::Vector3d error(difference.x, difference.y, difference.phi);
      EXPECT_LT(error.head<2>().norm(), 0.05);
      // A point of the scan and its wall in the reference are both noisy; 5 cm is what LoopClosurePlugin assumes.
      squares += error.dot((found.unit_covariance * 0.05 * 0.05).inverse() * error);
      ++count;
    }
  }
  EXPECT_LT(squares / count, 3) << "mean of the squared error over its covariance, 3 degrees of freedom";
}

TEST_P(ScanMatchers, AlongABareCorridorThePoseStaysWhereItWasGuessedAndIsCalledUncertain) {
  FloorPlan corridor;
  corridor.addPolygon({{-60, -1.5}, {60, -1.5}, {60, 1.5}, {-60, 1.5}});
  const auto reference = scanFrom(corridor, {0, 0, 0}, 0.005, 1, 8),
             scan = scanFrom(corridor, {0.5, 0.1, 0}, 0.005, 2, 8);
  const auto found = match(reference, scan, {0.3, 0, 2 * kDegree});
  EXPECT_NEAR(found.reference_from_scan.x, 0.3, GetParam().matcher == MatcherKind::point_to_line ? 0.01 : 0.5);
  EXPECT_NEAR(found.reference_from_scan.y, 0.1, 0.02);
  EXPECT_NEAR(found.reference_from_scan.phi, 0, 0.5 * kDegree);
  const auto& covariance = found.unit_covariance;
  EXPECT_GT(covariance(0, 0), 100 * covariance(1, 1)) << "along against across";
  EXPECT_GT(found.overlap, 0.9);
}

TEST_P(ScanMatchers, AStraightWallAloneFixesItsDistanceAndTheHeading) {
  FloorPlan wall;
  wall.walls.push_back({{2, -30}, {2, 30}});
  const auto reference = scanFrom(wall, {0, 0, 0}, 0, 1, 8), scan = scanFrom(wall, {0.3, 0, 0.1}, 0, 1, 8);
  const auto found = match(reference, scan, {0.2, 0, 0.05});
  EXPECT_NEAR(found.reference_from_scan.x, 0.3, 0.01);
  EXPECT_NEAR(found.reference_from_scan.phi, 0.1, 0.2 * kDegree);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(found.unit_covariance);
  EXPECT_GT(eigen.eigenvalues()[2], 100 * eigen.eigenvalues()[1]) << "one direction is free, the others are not";
  EXPECT_GT(std::abs(eigen.eigenvectors()(1, 2)), 0.9) << "the free one lies along the wall";
}

TEST_P(ScanMatchers, WithoutPointsTheGuessStandsAndTheOverlapIsZero) {
  const auto some = scanFrom(FloorPlan::box(), {0, 0, 0});
  const TPose2D guess(1, 2, 0.3);
  for (const auto& [reference, scan] : {std::pair{ScanWithNormals(), some}, std::pair{some, ScanWithNormals()},
                                        std::pair{ScanWithNormals(), ScanWithNormals()}}) {
    const auto found = match(reference, scan, guess);
    EXPECT_EQ(found.overlap, 0);
    EXPECT_EQ(found.reference_from_scan, guess);
    EXPECT_GT(found.unit_covariance(0, 0), 1e3);
  }
}

TEST_P(ScanMatchers, ScansOfDifferentPlacesOverlapLittle) {
  const auto plan = FloorPlan::ring();
  const auto found = match(scanFrom(plan, {0, 0, 0}), scanFrom(plan, {8.4, 3, 1.6}), {0, 0, 0});
  EXPECT_LT(found.overlap, 0.7) << "corridors are all alike in width, but their corners are not";
  const auto far = match(scanFrom(plan, {0, 0, 0}), scanFrom(plan, {0, 0, 0}), {100, 0, 0});
  EXPECT_EQ(far.overlap, 0);
}

TEST_P(ScanMatchers, GivesTheSameBitsForTheSameScans) {
  const auto plan = FloorPlan::ring();
  const auto reference = scanFrom(plan, {0, 0, 0}, 0.01, 1), scan = scanFrom(plan, {0.4, 0, 0.1}, 0.01, 2);
  const auto first = match(reference, scan, {0.3, 0, 0});
  match(scan, reference, {});
  const auto again = match(reference, scan, {0.3, 0, 0});
  EXPECT_EQ(again.reference_from_scan, first.reference_from_scan);
  EXPECT_EQ(again.unit_covariance, first.unit_covariance);
}

}  // namespace
}  // namespace omnimapper::matching::scan_matchers_test
