#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/plugin/SessionStart.h>

#include <cmath>

namespace omnimapper::mapper::session_start_test {
namespace {

using mrpt::poses::CPose3D;

// A map of two key frames 30 m and 40 m apart, and a session of two key frames that no factor ties to it.
class PlacedSession : public ::testing::Test {
 protected:
  PlacedSession() {
    map_.sessions.push_back({0, "old", {}, true});
    add({0, 0, 0, 0, 0, 0}, 0);
    add({30, 40, 0, 1, 0, 0}, 1);
    graph_.setSession(1);
    map_.sessions.push_back(
        {1, "new", graph_.addVariable(poseVariable(Motion::planar), poseValue(Motion::planar, {})), false});
    graph_.addFactor(startFactor(Motion::planar, map_.sessions[1].anchor, {{}, 1, 0.5}));
    first_ = add({0, 0, 0, 0, 0, 0}, 2);
    second_ = add({2, 0, 0, 0, 0, 0}, 3);
  }
  base::KeyFrameId add(const CPose3D& pose, double seconds) {
    map::KeyFrame frame;
    frame.id = map_.key_frames.nextId(graph_.session());
    frame.stamp = base::stampFromUnix(1e9 + seconds);
    frame.map_from_base = pose;
    frame.pose = graph_.addVariable(poseVariable(Motion::planar), poseValue(Motion::planar, pose));
    const auto id = frame.id;
    map_.key_frames.insert(std::move(frame));
    return id;
  }
  static void expectPose(const CPose3D& pose, double x, double y, double yaw) {
    EXPECT_NEAR(pose.x(), x, 1e-12);
    EXPECT_NEAR(pose.y(), y, 1e-12);
    EXPECT_NEAR(pose.yaw(), yaw, 1e-12);
  }
  map::Map map_;
  graph::Graph graph_;
  base::KeyFrameId first_, second_;
};

TEST_F(PlacedSession, MovesAsAWholeAndIsHeldThere) {
  Batch batch;
  batch.placeSession({second_, {CPose3D(10, 5, 0, M_PI / 2, 0, 0), 25, 3}});
  EXPECT_FALSE(batch.empty());
  apply(batch, {"test", {}}, graph_, map_);
  expectPose(map_.keyFrame(second_).map_from_base, 10, 5, M_PI / 2);
  expectPose(map_.keyFrame(first_).map_from_base, 10, 3, M_PI / 2);
  expectPose(poseOf(graph_, map_.keyFrame(first_).pose), 10, 3, M_PI / 2);
  expectPose(poseOf(graph_, map_.sessions[1].anchor), 10, 3, M_PI / 2);
  expectPose(map_.key_frames[1].map_from_base, 30, 40, 1);
  const auto& factors = graph_.factorsOf(map_.sessions[1].anchor);
  ASSERT_EQ(factors.size(), 1U);
  EXPECT_LT(graph_.whitenedResidual(factors[0]).norm(), 1e-12);
  EXPECT_NEAR(graph_.factor(factors[0]).noise.covariance()(0, 0), 25 * 25, 1e-9);
}

TEST_F(PlacedSession, TakesLandmarksOfItsOwnWithItAndLeavesThoseOfTheMap) {
  const auto add_point = [&](const Eigen::Vector2d& place) {
    map::Landmark landmark;
    const auto variable = graph_.addVariable(graph::point2(), place);
    landmark.variables = {variable};
    map_.landmarks.add(graph_.session(), std::move(landmark));
    return variable;
  };
  const auto own = add_point({3, 1});
  graph_.setSession(0);
  const auto of_map = add_point({3, 1});
  placeSession({second_, {CPose3D(10, 5, 0, M_PI / 2, 0, 0), 25, 3}}, graph_, map_);
  EXPECT_LT((graph_.value(own) - Eigen::Vector2d(9, 6)).norm(), 1e-12);
  EXPECT_EQ(graph_.value(of_map), Eigen::Vector2d(3, 1));
}

TEST_F(PlacedSession, OneThatIsAlignedOrOfThePastIsNotMoved) {
  Batch batch;
  batch.placeSession({map_.key_frames[0].id, {}});
  EXPECT_NE(whyUnfit(batch, graph_, map_), "");
  batch.placeSession({second_, {}});
  EXPECT_EQ(whyUnfit(batch, graph_, map_), "");
  map_.sessions[1].aligned = true;
  EXPECT_NE(whyUnfit(batch, graph_, map_), "");
  EXPECT_THROW(apply(batch, {"test", {}}, graph_, map_), base::Error);
}

TEST_F(PlacedSession, AnywhereIsTheMiddleOfTheMapAndAsUncertainAsItIsLarge) {
  const auto start = startAnywhere(map_);
  EXPECT_NEAR(start.map_from_base.x(), 15, 1e-12);
  EXPECT_NEAR(start.map_from_base.y(), 20, 1e-12);
  EXPECT_NEAR(start.position_sigma, 25, 1e-12);
  EXPECT_NEAR(start.angle_sigma, M_PI, 1e-12);
}

}  // namespace
}  // namespace omnimapper::mapper::session_start_test
