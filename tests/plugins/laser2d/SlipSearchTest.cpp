// A drive of 24 m through a hall, with one key frame each metre. Between two of them the map has a wrong motion, and
// closures at the end measure the true pose of the robot.
#include <gtest/gtest.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/matching/ScanMatcherOptions.h>
#include <omnimapper/testing/HandMadeRun.h>

#include "WallWorlds.h"
#include "laser2d/SlipSearch.h"

namespace omnimapper::plugins::slip_search_test {
namespace {

using geometry::Se2;
using mrpt::poses::CPose3D;
using namespace wall_worlds;

// 14 x 10 m, with fins that are all different.
World hall() {
  auto world = room(14, 10);
  const std::vector<Wall> fins{{{-4, -5}, {-4, -3.2}}, {{1.5, -5}, {1.5, -4}}, {{7, -1}, {5.6, -1}},
                               {{7, 2.5}, {6.2, 2}},   {{3, 5}, {2.4, 3.7}},   {{-2, 5}, {-2, 4.2}},
                               {{-7, 2}, {-5.8, 2}},   {{-7, -1.5}, {-6, -1}}};
  world.insert(world.end(), fins.begin(), fins.end());
  return world;
}

// On a circle of 3 m, forwards.
Se2 onCircle(double angle) {
  return {3 * std::sin(angle), -3 * std::cos(angle), geometry::wrapToPi(angle)};
}

class SlipSearchTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kFrames = 24, kSlipped = 11;  // the motion from this key frame to the next is wrong

  Se2 trueMapFromBase(std::size_t i) const {
    return onCircle(static_cast<double>(i) / 3 + (i > kSlipped ? unseen_ : 0));
  }

  void drive(const Se2& slip) {
    Se2 map_from_base = trueMapFromBase(0);
    for (std::size_t i = 0; i < kFrames; ++i) {
      if (i > 0) {
        const Se2 step = geometry::inverse(trueMapFromBase(i - 1)) * trueMapFromBase(i);
        map_from_base = map_from_base * step * (i == kSlipped + 1 ? slip : Se2());
      }
      const auto& frame = run_.addFrame(CPose3D(mrpt::poses::CPose2D(geometry::toMrpt(map_from_base))));
      poses_.push_back(map_from_base);
      if (i > 0) {
        step_ =
            run_.graph.addFactor({{run_.map.key_frames[i - 1].pose, frame.pose},
                                  std::make_shared<graph::BetweenSe2>(geometry::inverse(poses_[i - 1]) * map_from_base),
                                  graph::SquareRootInformation::fromSigmas(Eigen::Vector3d(0.01, 0.01, 0.003))});
      }
      if (i == kSlipped + 1) slipped_ = step_;
      const auto truth = CPose3D(mrpt::poses::CPose2D(geometry::toMrpt(trueMapFromBase(i))));
      drive_.push_back({frame.id, scanFrom(truth, world_, reach_), static_cast<double>(i)});
    }
    run_.uncertainty = mapper::Uncertainty(run_.graph);
  }

  void refuse(std::size_t place, std::size_t newest, const Se2& error = {}) {
    graph::FactorRecord record{{run_.map.key_frames[place].pose, run_.map.key_frames[newest].pose},
                               std::make_shared<graph::BetweenSe2>(geometry::inverse(trueMapFromBase(place)) *
                                                                   trueMapFromBase(newest) * error),
                               graph::SquareRootInformation::fromSigmas(Eigen::Vector3d(0.03, 0.03, 0.01))};
    record.weight = 0;
    record.tags.hypothesis = true;
    refused_.push_back(run_.graph.addFactor(record));
  }

  mapper::Batch search() {
    mapper::PluginContext context;
    context.section = "loop_closure";
    return SlipSearch({}, context, matching::makeMatcher({}), refused_, drive_)(run_.view());
  }

  World world_ = hall();
  double reach_ = 8;   // [m] of the laser
  double unseen_ = 0;  // [rad] of the circle that the robot drives in addition where it slips
  testing::HandMadeRun run_;
  std::vector<Se2> poses_;
  std::vector<LoopSearch::KeyScan> drive_;
  std::vector<base::FactorId> refused_;
  base::FactorId step_, slipped_;
};

TEST_F(SlipSearchTest, TheSpanThatSlippedGetsTheMotionThatTheScansFit) {
  drive({0.9, -0.6, 0.5});
  refuse(1, 20);
  refuse(3, 23);
  const auto batch = search();
  ASSERT_EQ(batch.decisions().size(), 1U);
  const auto& decision = batch.decisions()[0];
  ASSERT_TRUE(decision.accepted) << decision.reason;
  EXPECT_EQ(decision.kind, kSlip);
  EXPECT_EQ(*decision.to, run_.map.key_frames[kSlipped].id);
  EXPECT_EQ(decision.from, run_.map.key_frames[kSlipped + 1].id);
  EXPECT_EQ(batch.weights(), (std::vector<std::pair<base::FactorId, double>>{{slipped_, 0}}));
  ASSERT_EQ(batch.addedFactors().size(), 1U);
  const auto& added = batch.addedFactors()[0];
  EXPECT_FALSE(added.tags.hypothesis);
  const auto& measured = dynamic_cast<const graph::BetweenSe2&>(*added.factor).measured();
  const Se2 truth = geometry::inverse(trueMapFromBase(kSlipped)) * trueMapFromBase(kSlipped + 1);
  EXPECT_LT(minus(measured, truth).norm(), 0.02);
}

// The robot drives a third of the circle without scans, and its wheels slip there.
TEST_F(SlipSearchTest, TheOnlySpanThatNoScansConfirmGetsTheMotionOfTheClosures) {
  world_ = room(9.6, 9.6);
  world_.push_back({{-4.8, 1}, {-3.8, 1}});
  world_.push_back({{1, 4.8}, {1.5, 4}});
  world_.push_back({{4.8, -1}, {4, -0.5}});
  reach_ = 2.9;
  unseen_ = 2.2;
  drive({-2.5, 1.5, 1});
  refuse(1, 20);
  refuse(3, 23);
  const auto batch = search();
  ASSERT_EQ(batch.decisions().size(), 1U);
  ASSERT_TRUE(batch.decisions()[0].accepted) << batch.decisions()[0].reason;
  EXPECT_EQ(batch.decisions()[0].reason, "closures that agree contradict the motion here, which no scans confirm");
  EXPECT_EQ(*batch.decisions()[0].to, run_.map.key_frames[kSlipped].id);
  ASSERT_EQ(batch.addedFactors().size(), 1U);
  const auto& measured = dynamic_cast<const graph::BetweenSe2&>(*batch.addedFactors()[0].factor).measured();
  const Se2 truth = geometry::inverse(trueMapFromBase(kSlipped)) * trueMapFromBase(kSlipped + 1);
  EXPECT_LT(minus(measured, truth).norm(), 1e-6);
  EXPECT_GT(1 / batch.addedFactors()[0].noise.information()(0, 0), 0.5) << "as uncertain as the map between them";
}

TEST_F(SlipSearchTest, OneClosureAloneChangesNothing) {
  drive({0.9, -0.6, 0.5});
  refuse(1, 20);
  EXPECT_TRUE(search().empty());
}

TEST_F(SlipSearchTest, ClosuresThatContradictOneAnotherChangeNothing) {
  drive({0.9, -0.6, 0.5});
  refuse(1, 20, {2, 0, 0});
  refuse(3, 23);
  EXPECT_TRUE(search().empty());
}

TEST_F(SlipSearchTest, ClosuresThatActAreNoReason) {
  drive({0.9, -0.6, 0.5});
  refuse(1, 20);
  refuse(3, 23);
  run_.graph.setWeight(refused_[0], 1);
  EXPECT_TRUE(search().empty());
}

// All motions are right, and the closures confuse two places: no scans fit at the motion they require.
TEST_F(SlipSearchTest, ClosuresThatAgreeOnAPlaceWhereTheRobotWasNotMoveNothing) {
  drive({});
  const Se2 other{1.5, 0.7, 0.3};  // in the frame of the place
  const auto wrong = [&](std::size_t place, std::size_t newest) {
    const Se2 right = geometry::inverse(trueMapFromBase(place)) * trueMapFromBase(newest);
    const Se2 map_from_newest = other * trueMapFromBase(newest);
    refuse(place, newest, geometry::inverse(right) * geometry::inverse(trueMapFromBase(place)) * map_from_newest);
  };
  wrong(1, 20);
  wrong(3, 23);
  const auto batch = search();
  ASSERT_EQ(batch.decisions().size(), 1U);
  EXPECT_FALSE(batch.decisions()[0].accepted);
  EXPECT_FALSE(batch.changesGraph());
}

// The place of the closures is 20 m from the robot: the motion over one metre cannot be wrong by that much.
TEST_F(SlipSearchTest, ClosuresThatNoSlipLeadsToAreOfPlacesThatLookAlike) {
  drive({});
  refuse(1, 20, {20, 0, 0});
  refuse(3, 22,
         geometry::inverse(geometry::inverse(trueMapFromBase(20)) * trueMapFromBase(22)) * Se2{20, 0, 0} *
             (geometry::inverse(trueMapFromBase(20)) * trueMapFromBase(22)));
  const auto batch = search();
  ASSERT_EQ(batch.decisions().size(), 1U);
  EXPECT_NE(batch.decisions()[0].kind, kSlip);
  EXPECT_FALSE(batch.decisions()[0].accepted);
  EXPECT_FALSE(batch.changesGraph());
}

}  // namespace
}  // namespace omnimapper::plugins::slip_search_test
