// Tests the factor, the variable and the plugin of the example in doc/add_a_landmark_type.md.
#include <BeaconFactor.h>
#include <BeaconPayload.h>
#include <BeaconPlugin.h>
#include <BeaconVariable.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <sstream>

#include "../graph/Jacobians.h"

namespace beacons {
namespace beacon_example_test {
namespace {

using Eigen::Vector3d;
using omnimapper::geometry::kPi;
using omnimapper::geometry::Se3;
using omnimapper::testing::Dice;
using omnimapper::testing::SimulatedLog;
using omnimapper::testing::SimulatedLogOptions;
namespace base = omnimapper::base;
namespace geometry = omnimapper::geometry;
namespace graph = omnimapper::graph;
namespace map = omnimapper::map;
namespace mapper = omnimapper::mapper;
namespace testing = omnimapper::testing;

const std::vector<std::shared_ptr<const graph::Variable>> kGiven{graph::se3(), beaconVariable()};
const std::vector<std::shared_ptr<const graph::Variable>> kEstimated{graph::se3(), graph::se3(), beaconVariable()};

Se3 anyPose(Dice& dice, double reach) {
  const auto any = [&](double bound) { return dice.uniform(-bound, bound); };
  return {geometry::expSo3({any(1.5), any(1.5), any(1.5)}), {any(reach), any(reach), any(reach)}};
}

// The measurement of a sensor without noise.
Vector3d exactMeasurement(const Se3& map_from_sensor, const Vector3d& beacon) {
  double range, yaw, pitch;
  geometry::toMrpt(map_from_sensor).sphericalCoordinates({beacon.x(), beacon.y(), beacon.z()}, range, yaw, pitch);
  return {range, yaw, pitch};
}

TEST(BeaconVariable, MovesOnThePlaneOfItsHeight) {
  const Vector3d x(1, 2, 3);
  const Eigen::Vector2d delta(0.5, -4);
  Vector3d y;
  Eigen::Vector2d back;
  beaconVariable()->plus(x.data(), delta.data(), y.data());
  EXPECT_EQ(y, Vector3d(1.5, -2, 3));
  beaconVariable()->minus(y.data(), x.data(), back.data());
  EXPECT_EQ(back, delta);
}

TEST(BeaconFactor, ResidualAsWorkedByHand) {
  // The base points along the map's y; the sensor, half a metre ahead and a metre up, points to its right, along x.
  const Se3 map_from_base{geometry::expSo3({0, 0, kPi / 2}), {1, 2, 0}};
  const Se3 base_from_sensor{geometry::expSo3({0, 0, -kPi / 2}), {0.5, 0, 1}};
  // The sensor is therefore at (1, 2.5, 1) in the map and the beacon at (3, 4, 5) in the sensor frame: 45 deg up.
  const Vector3d beacon(4, 6.5, 6), measured(7, 0.9, -0.8);
  const Eigen::VectorXd pose = graph::toValue(map_from_base);
  const BeaconFactor given(measured, base_from_sensor, false);
  const Eigen::VectorXd r = graph::Evaluation{given, kGiven, {pose, beacon}}.residual();
  EXPECT_LT((r - Vector3d(std::sqrt(50.0) - 7, std::atan2(4, 3) - 0.9, 0.8 - kPi / 4)).norm(), 1e-12) << r.transpose();

  // After another quarter turn to the left the beacon is at (4, -3, 5) in the sensor frame.
  const BeaconFactor estimated(measured, base_from_sensor, true);
  const Eigen::VectorXd correction = graph::toValue(Se3{geometry::expSo3({0, 0, kPi / 2}), Vector3d::Zero()});
  const Eigen::VectorXd turned = graph::Evaluation{estimated, kEstimated, {pose, correction, beacon}}.residual();
  EXPECT_LT((turned - Vector3d(r[0], std::atan2(-3, 4) - 0.9, r[2])).norm(), 1e-12) << turned.transpose();
}

TEST(BeaconFactor, YawBehindTheSensorIsWrapped) {
  const BeaconFactor factor({1, 3.1, 0}, Se3(), false);
  const Vector3d beacon(-std::cos(0.05), -std::sin(0.05), 0);  // yaw -pi + 0.05
  const Eigen::VectorXd r = graph::Evaluation{factor, kGiven, {graph::toValue(Se3()), beacon}}.residual();
  EXPECT_NEAR(r[1], kPi + 0.05 - 3.1, 1e-12);
}

TEST(BeaconFactor, JacobiansMatchDifferences) {
  Dice dice(1);
  for (int i = 0; i < 20; ++i) {
    const Vector3d beacon(dice.uniform(-9, 9), dice.uniform(-9, 9), dice.uniform(-9, 9));
    const Se3 map_from_base = anyPose(dice, 9), base_from_sensor = anyPose(dice, 1), correction = anyPose(dice, 0.5);
    const auto measured = exactMeasurement(map_from_base * base_from_sensor * correction, beacon);
    const BeaconFactor given(measured, base_from_sensor, false), estimated(measured, base_from_sensor, true);
    const Eigen::VectorXd pose = graph::toValue(map_from_base), sensor = graph::toValue(correction);
    graph::expectJacobiansMatchDifferences({estimated, kEstimated, {pose, sensor, beacon}});
    // Also away from the measurement, but not where the yaw wraps around.
    graph::expectJacobiansMatchDifferences({given, kGiven, {pose, beacon}});
  }
}

TEST(BeaconFactor, FindsBeaconAndSensorFromExactMeasurements) {
  Dice dice(2);
  const Vector3d truth(3, -2, 1.4);
  const Se3 base_from_reported{geometry::expSo3({0, 0.1, 0.3}), {0.2, 0, 0.5}};
  const Se3 reported_from_sensor{geometry::expSo3({0.02, -0.03, 0.05}), {0.03, -0.02, 0.01}};
  graph::Graph graph;
  const auto beacon = graph.addVariable(beaconVariable(), Vector3d(3.4, -1.5, 1.4));
  const auto correction = graph.addVariable(graph::se3(), graph::toValue(Se3()));
  for (int i = 0; i < 10; ++i) {
    const Se3 map_from_base = anyPose(dice, 4);
    const auto pose = graph.addVariable(graph::se3(), graph::toValue(map_from_base), true);
    const auto measured = exactMeasurement(map_from_base * base_from_reported * reported_from_sensor, truth);
    graph.addFactor({{pose, correction, beacon},
                     std::make_shared<BeaconFactor>(measured, base_from_reported, true),
                     graph::SquareRootInformation::identity(3)});
  }
  graph::solve(graph);
  EXPECT_LT((graph.value(beacon) - truth).norm(), 1e-6) << graph.value(beacon).transpose();
  EXPECT_LT(minus(graph::se3FromValue(graph.value(correction).data()), reported_from_sensor).norm(), 1e-6);
}

TEST(BeaconFactor, IsReadBackAsItWasWritten) {
  const Vector3d beacon(3, -2, 1.4);
  const Eigen::VectorXd pose = graph::toValue(Se3{geometry::expSo3({0, 0, 0.3}), {1, 2, 0}});
  const Eigen::VectorXd correction = graph::toValue(Se3{geometry::expSo3({0.1, 0, 0}), {0, 0, 0.1}});
  const Se3 base_from_sensor{geometry::expSo3({0, 0.1, 0.3}), {0.2, 0, 0.5}};
  mapper::Kinds kinds;
  BeaconPlugin::registerKinds(kinds);
  for (const bool estimated : {false, true}) {
    const BeaconFactor written({4, 0.1, -0.2}, base_from_sensor, estimated);
    std::stringstream bytes;
    written.write(bytes);
    const std::string text = bytes.str();
    const auto read = kinds.factors.readFactor("beacon_measurement", bytes);
    const auto at =
        estimated ? std::vector<Eigen::VectorXd>{pose, correction, beacon} : std::vector<Eigen::VectorXd>{pose, beacon};
    const auto& variables = estimated ? kEstimated : kGiven;
    EXPECT_EQ((graph::Evaluation{*read, variables, at}.residual()),
              (graph::Evaluation{written, variables, at}.residual()));
    std::istringstream cut(text.substr(0, text.size() - 1));
    EXPECT_THROW(kinds.factors.readFactor("beacon_measurement", cut), base::Error);
  }
}

TEST(BeaconPayload, IsReadBackAsItWasWrittenAndAnUnknownVersionIsRefused) {
  map::PayloadRegistry registry;
  BeaconPayload::addTo(registry);
  std::ostringstream out;
  BeaconPayload(7, 1.25, 8.5).write(out);
  const auto read = std::dynamic_pointer_cast<const BeaconPayload>(registry.read("beacon", out.str()));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->number, 7);
  EXPECT_EQ(read->nearest, 1.25);
  EXPECT_EQ(read->farthest, 8.5);
  std::string later = out.str();
  later[0] = 9;
  EXPECT_THROW(registry.read("beacon", later), base::Error);
}

}  // namespace
}  // namespace beacon_example_test
}  // namespace beacons
