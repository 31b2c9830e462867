#include <gtest/gtest.h>
#include <omnimapper/derived/SessionAlignment.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/PoseFactors.h>

namespace omnimapper::derived::session_alignment_test {
namespace {

// Three sessions of two key frames each, linked within themselves.
struct ThreeSessions {
  map::Map map;
  graph::Graph graph;

  ThreeSessions() {
    for (std::uint16_t session = 0; session < 3; ++session) {
      graph.setSession(session);
      map.sessions.push_back({session, "", {session, 0}, session == 0});
      for (std::uint32_t i = 0; i < 2; ++i) {
        map::KeyFrame frame;
        frame.id = {session, i};
        frame.stamp = base::stampFromUnix(1e9 + i);
        frame.pose = graph.addVariable(mapper::poseVariable(mapper::Motion::planar), Eigen::Vector3d(i, session, 0));
        map.key_frames.insert(frame);
      }
      bind({session, 0}, {session, 1}, "odometry");
    }
  }
  base::FactorId bind(base::KeyFrameId from, base::KeyFrameId to, const std::string& owner) {
    graph.setSession(std::max(from.session, to.session));
    return graph.addFactor(mapper::betweenPoses(mapper::Motion::planar, map.keyFrame(from).pose, map.keyFrame(to).pose,
                                                {{}, Eigen::Matrix<double, 6, 6>::Identity()}, owner));
  }
  std::vector<base::VariableId> pointsOf(const std::vector<std::uint16_t>& sessions) {
    std::vector<base::VariableId> points;
    for (const auto session : sessions) {
      graph.setSession(session);
      points.push_back(graph.addVariable(graph::point2(), Eigen::Vector2d(1, 2)));
    }
    return points;
  }
  bool aligned(std::size_t session) {
    derived::markAligned(map, graph, {"gps"});
    return map.sessions[session].aligned;
  }
};

TEST(SessionAlignment, ASessionIsAlignedByAFactorToTheFirstOneThatActs) {
  ThreeSessions world;
  EXPECT_TRUE(world.aligned(0));
  EXPECT_FALSE(world.aligned(1));
  const auto id = world.bind({0, 1}, {1, 1}, "loop_closure");
  EXPECT_TRUE(world.aligned(1));
  EXPECT_EQ(world.map.sessions[1].aligned_at, (base::KeyFrameId{1, 1}));
  EXPECT_EQ(derived::alignedText(world.map.sessions[1]), "session 1 was aligned at key frame 1:1");
  EXPECT_FALSE(world.aligned(2));
  world.graph.setWeight(id, 0);  // revoked
  EXPECT_FALSE(world.aligned(1));
  EXPECT_FALSE(world.map.sessions[1].aligned_at);
  EXPECT_EQ(derived::alignedText(world.map.sessions[1]), "session 1 was never aligned");
}

TEST(SessionAlignment, ManyTiesThatAreRefusedMakeItUncertain) {
  ThreeSessions world;
  const auto tie = [&](double weight) {
    const auto id = world.bind({0, 1}, {1, 1}, "loop_closure");
    graph::FactorRecord record = world.graph.factor(id);
    world.graph.removeFactor(id);
    record.tags.hypothesis = true;
    record.weight = weight;
    world.graph.addFactor(record);
  };
  for (int i = 0; i < 5; ++i) tie(1);
  tie(0);
  tie(0);
  EXPECT_FALSE(derived::testedTies(world.graph, 1).areMostlyRefused());
  tie(0);
  EXPECT_EQ(derived::testedTies(world.graph, 1).accepted, 5U);
  EXPECT_EQ(derived::testedTies(world.graph, 1).refused, 3U);
  EXPECT_TRUE(derived::testedTies(world.graph, 1).areMostlyRefused());
  EXPECT_EQ(derived::testedTies(world.graph, 2).accepted, 0U);
}

TEST(SessionAlignment, ASessionIsAlignedByWayOfAnother) {
  ThreeSessions world;
  world.bind({1, 0}, {2, 0}, "loop_closure");
  EXPECT_FALSE(world.aligned(1));
  EXPECT_FALSE(world.aligned(2)) << "tied to each other, but not to the map";
  world.bind({0, 0}, {2, 1}, "loop_closure");
  EXPECT_TRUE(world.aligned(1));
  EXPECT_TRUE(world.aligned(2));
  EXPECT_EQ(world.map.sessions[1].aligned_at, (base::KeyFrameId{2, 1}));
}

TEST(SessionAlignment, APlaceInTheMapJoinsIfItsPluginGivesAbsolutePoses) {
  ThreeSessions world;
  const auto prior = [&](base::KeyFrameId id, const std::string& owner) {
    world.graph.setSession(id.session);
    world.graph.addFactor(mapper::posePrior(mapper::Motion::planar, world.map.keyFrame(id).pose, {},
                                            Eigen::Matrix<double, 6, 6>::Identity(), owner));
  };
  prior({1, 0}, "engine");
  EXPECT_FALSE(world.aligned(1)) << "a guess of the start is no measurement";
  prior({1, 1}, "gps");
  EXPECT_TRUE(world.aligned(1));
}

// A factor between two landmarks, for example that two points have the same height.
class SameHeight : public graph::Factor {
 public:
  std::string_view kind() const override { return "same_height"; }
  int residualSize() const override { return 1; }
  const std::vector<std::string_view>& variableKinds() const override {
    static const std::vector<std::string_view> kinds = {"point2", "point2"};
    return kinds;
  }
  void evaluate(const double* const* values, double* residual, double* const*) const override {
    residual[0] = values[1][1] - values[0][1];
  }
  void write(std::ostream&) const override {}
};

TEST(SessionAlignment, LandmarksJoinByWhoSeesThemAndNotByHowTheyStandToEachOther) {
  ThreeSessions world;
  const auto points = world.pointsOf({0, 1});
  world.graph.addFactor({points, std::make_shared<SameHeight>(), graph::SquareRootInformation::identity(1)});
  EXPECT_FALSE(world.aligned(1));
  world.graph.addFactor({{world.map.keyFrame({1, 1}).pose, points[0]},
                         std::make_shared<graph::PointFactor2>(Eigen::Vector2d(1, 0)),
                         graph::SquareRootInformation::identity(2)});
  EXPECT_TRUE(world.aligned(1));
  EXPECT_EQ(world.map.sessions[1].aligned_at, (base::KeyFrameId{1, 1}));
}

TEST(SessionAlignment, ASessionIsLocatedByWhatItSeesAndNotByHowLandmarksStandToEachOther) {
  ThreeSessions world;
  const auto points = world.pointsOf({0, 2});
  world.graph.addFactor({points, std::make_shared<SameHeight>(), graph::SquareRootInformation::identity(1)});
  derived::markLocated(world.map, world.graph, {"gps"});
  EXPECT_FALSE(world.map.sessions[2].aligned);
  world.graph.addFactor({{world.map.keyFrame({2, 1}).pose, points[0]},
                         std::make_shared<graph::PointFactor2>(Eigen::Vector2d(1, 0)),
                         graph::SquareRootInformation::identity(2)});
  derived::markLocated(world.map, world.graph, {"gps"});
  EXPECT_TRUE(world.map.sessions[2].aligned);
  EXPECT_EQ(world.map.sessions[2].aligned_at, (base::KeyFrameId{2, 1}));
}

}  // namespace
}  // namespace omnimapper::derived::session_alignment_test
