#include <gtest/gtest.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/interaction/readBody.h>

#include <cmath>
#include <limits>

#include "Bodies.h"

namespace omnimapper::interaction::read_body_test {
namespace {

using Eigen::Vector3d;
using mrpt::obs::CObservationSkeleton;

void expectThePerson(const BodyReading& reading, const char* how) {
  ASSERT_TRUE(reading.body) << how << ": " << reading.why_not;
  const TrackedBody& body = *reading.body;
  ASSERT_TRUE(body.right.hand && body.right.elbow && body.left.hand && body.head) << how;
  EXPECT_LT((body.right.hand->at - Vector3d(1.4, 0.2, 1.3)).norm(), 1e-9) << how;
  EXPECT_LT((body.left.hand->at - Vector3d(2, -0.22, 0.76)).norm(), 1e-9) << how;
  EXPECT_LT((body.head->at - Vector3d(2, 0, 1.6)).norm(), 1e-9) << how;
  EXPECT_FALSE(body.head->is_guessed);
  EXPECT_FALSE(looksAway(body)) << how;
}

// The same person, as a tracker with this unit, axes and sensor pose writes it.
CObservationSkeleton written(double scale, const geometry::Se3& base_from_sensor,
                             const Eigen::Matrix3d& tracker_from_sensor) {
  auto s = moved(standingPerson(), [&](const Vector3d& in_base) -> Vector3d {
    return scale * (tracker_from_sensor * (geometry::inverse(base_from_sensor) * in_base));
  });
  s.sensorPose = geometry::toMrpt(base_from_sensor);
  return s;
}

TEST(readBody, unitsAndAxesAreRecognised) {
  const geometry::Se3 forward{Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Vector3d::UnitY())), {0.1, 0, 1.2}};
  const geometry::Se3 optical = forward * geometry::sensorFromOptical();
  const Eigen::Matrix3d same = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d flipped = same, forward_y_up, forward_optical;
  flipped(1, 1) = -1;
  forward_y_up << 0, -1, 0, 0, 0, 1, 1, 0, 0;      // x right, y up, z ahead
  forward_optical << 0, -1, 0, 0, 0, -1, 1, 0, 0;  // x right, y down, z ahead
  for (const double scale : {1.0, 1000.0}) {
    expectThePerson(readBody(written(scale, forward, same), {}), "the sensor's own axes");
    expectThePerson(readBody(written(scale, optical, same), {}), "optical, as the simulator");
    expectThePerson(readBody(written(scale, optical, flipped), {}), "optical with y up");
    expectThePerson(readBody(written(scale, forward, forward_y_up), {}), "as MRPT's driver of NiTE");
    expectThePerson(readBody(written(scale, forward, forward_optical), {}), "optical, but a pose that looks along x");
  }
}

TEST(readBody, declaredUnitsAndAxesAreTaken) {
  const geometry::Se3 forward{Eigen::Quaterniond::Identity(), {0, 0, 0}};
  SkeletonFormat format;
  format.unit = SkeletonUnit::mm;
  format.axes = SkeletonAxes::sensor;
  expectThePerson(readBody(written(1000, forward, Eigen::Matrix3d::Identity()), format), "declared");
  format.unit = SkeletonUnit::m;
  const auto reading = readBody(written(1000, forward, Eigen::Matrix3d::Identity()), format);
  EXPECT_FALSE(reading.body);
  EXPECT_EQ(reading.why_not, "its limbs are longer than 1 m");
}

TEST(readBody, jointsThatAreNoPlacesAreMissing) {
  auto s = standingPerson();
  s.right_elbow.x = std::numeric_limits<double>::quiet_NaN();
  s.left_hand.z = std::numeric_limits<double>::infinity();
  s.neck = TrackedJoint();
  s.left_elbow.conf = 0;
  s.head.conf = 0.5;
  const auto reading = readBody(s, {});
  ASSERT_TRUE(reading.body) << reading.why_not;
  EXPECT_FALSE(reading.body->right.elbow);
  EXPECT_FALSE(reading.body->left.hand);
  EXPECT_FALSE(reading.body->left.elbow);
  EXPECT_FALSE(reading.body->neck);
  ASSERT_TRUE(reading.body->head);
  EXPECT_TRUE(reading.body->head->is_guessed);
}

TEST(readBody, aTrackerThatStatesNoConfidenceIsBelieved) {
  auto s = standingPerson();
  for (const auto joint : trackedJoints()) (s.*joint).conf = 0;
  expectThePerson(readBody(s, {}), "no confidence");
}

TEST(readBody, whatIsNoPersonIsRefusedWithTheReason) {
  EXPECT_EQ(readBody({}, {}).why_not, "no hand is known together with its elbow or the head");
  const auto nan = moved(standingPerson(), [](const Vector3d& p) -> Vector3d { return std::nan("") * p; });
  EXPECT_EQ(readBody(nan, {}).why_not, "no hand is known together with its elbow or the head");
  const auto lying = moved(standingPerson(), [](const Vector3d& p) -> Vector3d { return {2 + p.z(), p.y(), 0}; });
  EXPECT_EQ(readBody(lying, {}).why_not, "with no axes its trunk stands upright (skeleton_axes declares them)");
  const auto giant = moved(standingPerson(), [](const Vector3d& p) -> Vector3d { return 5 * p; });
  EXPECT_EQ(readBody(giant, {}).why_not, "its limbs are longer than 1 m");
}

// A mirrored skeleton is that of somebody who looks away; declared as mirrored, the right arm is the right one.
TEST(readBody, aMirroredTrackerIsNoticedAndDeclared) {
  auto s = standingPerson();
  std::swap(s.left_shoulder, s.right_shoulder);
  std::swap(s.left_elbow, s.right_elbow);
  std::swap(s.left_hand, s.right_hand);
  const auto reading = readBody(s, {});
  ASSERT_TRUE(reading.body);
  EXPECT_TRUE(looksAway(*reading.body));
  SkeletonFormat format;
  format.is_mirrored = true;
  expectThePerson(readBody(s, format), "declared as mirrored");
}

}  // namespace
}  // namespace omnimapper::interaction::read_body_test
