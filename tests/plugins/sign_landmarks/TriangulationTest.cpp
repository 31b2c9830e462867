#include <gtest/gtest.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <vector>

#include "sign_landmarks/SignMeasurement.h"
#include "sign_landmarks/Triangulation.h"

namespace omnimapper::plugins::sign_measurement_test {
namespace {

using Eigen::Vector3d;
using geometry::Se3;

constexpr double kDegree = geometry::kPi / 180;

/// Poses that look along x, and the views of a sign by a camera 1 m above each.
class Views {
 public:
  std::vector<SignView> views;
  graph::Graph graph;

  /// `error`: error of the direction to the left [rad]. `range` 0: not measured.
  void add(const Vector3d& base, const Vector3d& sign, double error = 0, double range = 0, double range_sigma = 0) {
    const auto pose = graph.addVariable(graph::se3(), graph::toValue(Se3{Eigen::Quaterniond::Identity(), base}));
    const Vector3d camera(0, 0, 1);
    const Vector3d direction = geometry::expSo3({0, 0, error}) * (sign - base - camera).normalized();
    SignMeasurement measurement{{}, MeasuredDirection(camera, direction), Vector3d::UnitY(), kDegree, kDegree, {}, 0, 0,
                                {}};
    if (range > 0) {
      measurement.range = range;
      measurement.range_sigma = range_sigma;
    }
    views.push_back({{}, {}, pose, "camera", measurement, 0});
  }

  std::optional<Triangulation> meeting(double max_sigma = 0.3) const {
    return triangulate(views, graph, {}, max_sigma, 3);
  }
};

const Vector3d kSign(3, 1, 1.5);

TEST(Triangulation, ThreeDirectionsFromThreePlacesMeetAtTheSign) {
  Views seen;
  for (const double y : {0., 0.6, 1.2}) seen.add({0, y, 0}, kSign);
  const auto found = seen.meeting();
  ASSERT_TRUE(found);
  EXPECT_LT((found->point - kSign).norm(), 1e-9);
  EXPECT_EQ(found->views.size(), 3U);
}

TEST(Triangulation, DirectionsFromOnePlaceDetermineNoDistance) {
  Views seen;
  for (const double error : {-0.3, 0., 0.3}) seen.add({0, 0, 0}, kSign, error * kDegree);
  EXPECT_FALSE(seen.meeting());
}

// The mean of three ranges with the same standard deviation has one that is smaller by the root of three.
TEST(Triangulation, RangesPlaceASignThatIsSeenFromOnePlace) {
  const double range = (kSign - Vector3d(0, 0, 1)).norm();
  Views seen;
  for (const double miss : {-0.03, 0., 0.03}) seen.add({0, 0, 0}, kSign, 0, range + miss, 0.06);
  const auto found = seen.meeting();
  ASSERT_TRUE(found);
  EXPECT_LT((found->point - kSign).norm(), 1e-6);
  EXPECT_NEAR(found->sigma, 0.06 / std::sqrt(3.), 1e-6);
  EXPECT_FALSE(seen.meeting(0.03)) << "it is not known so well";
}

TEST(Triangulation, ARangeThatFitsNoOtherViewIsLeftOut) {
  const double range = (kSign - Vector3d(0, 0, 1)).norm();
  Views seen;
  seen.add({0, 0, 0}, kSign, 0, range - 1.5, 0.03);  // as if a person stood in front of the sign
  for (int i = 0; i < 3; ++i) seen.add({0, 0, 0}, kSign, 0, range, 0.03);
  const auto found = seen.meeting();
  ASSERT_TRUE(found);
  EXPECT_LT((found->point - kSign).norm(), 1e-6);
  EXPECT_EQ(found->views, (std::vector<std::size_t>{1, 2, 3}));
}

// Two signs with the same text are 1.4 m apart on one wall: rays to both meet between them and the robot.
TEST(Triangulation, DirectionsToTwoSignsOfOneTextAreNotMixed) {
  const Vector3d other = kSign + Vector3d(0, 1.4, 0);
  Views seen;
  for (const double y : {0., 0.3, 0.6}) seen.add({0, y, 0}, other);
  for (const double y : {0.9, 1.2, 1.5}) seen.add({0, y, 0}, kSign);
  const KnownOffsets unknown{Eigen::Vector2d::Zero(), 3 * kDegree};
  const auto found = triangulate(seen.views, seen.graph, unknown, 2, 3);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->views, (std::vector<std::size_t>{3, 4, 5}));
  EXPECT_LT((found->point - kSign).norm(), 0.1);
}

TEST(SignMeasurements, KeepRangesThatSaySomething) {
  obs::CObservationDoorSigns observation;
  observation.sensorPose = mrpt::poses::CPose3D(0, 0, 1, -90 * kDegree, 0, -90 * kDegree);
  obs::ObservedDoorSign sign;
  sign.ray = Vector3d::UnitZ();
  sign.texts = {{"213", 0.97}};
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [range, sigma, is_kept] : {std::tuple{2., 0.05, true},
                                              {2., 0., false},
                                              {0., 0.05, false},
                                              {-2., 0.05, false},
                                              {nan, 0.05, false},
                                              {2., nan, false},
                                              {2., 1000., false}}) {
    sign.range = range;
    sign.range_sigma = sigma;
    observation.signs = {sign};
    const auto measurements = signMeasurements(observation, {});
    ASSERT_EQ(measurements.size(), 1U);
    EXPECT_EQ(measurements[0].range.has_value(), is_kept) << range << " +- " << sigma;
    EXPECT_EQ(measurements[0].rangeRecord(base::VariableId{1}, base::VariableId{2}).has_value(), is_kept);
  }
}

}  // namespace
}  // namespace omnimapper::plugins::sign_measurement_test
