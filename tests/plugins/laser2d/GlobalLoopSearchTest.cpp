// Earlier key frames saw all walls of two rooms, 15 m apart; now the robot is in the second room.
#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/matching/ScanMatcherOptions.h>
#include <omnimapper/testing/HandMadeRun.h>

#include "WallWorlds.h"
#include "laser2d/GlobalLoopSearch.h"

namespace omnimapper::plugins::global_loop_search_test {
namespace {

using mrpt::poses::CPose3D;
using namespace wall_worlds;

constexpr double kApart = 15;  // [m]
constexpr char kLabel[] = "laser.points";

World twoRooms() {
  auto world = room(7, 5);
  world.push_back({{1, 2.5}, {1, 1.4}});
  world.push_back({{-3.5, -1}, {-2.4, -1}});
  for (auto wall : room(5, 6))
    world.push_back({wall.from + Eigen::Vector2d(kApart, 0), wall.to + Eigen::Vector2d(kApart, 0)});
  world.push_back({{kApart - 1, 3}, {kApart - 1, 1.6}});
  world.push_back({{kApart + 2.5, -1}, {kApart + 1.3, -1.5}});
  return world;
}

class GlobalLoopSearchTest : public ::testing::Test {
 protected:
  GlobalLoopSearchTest() {
    run_.map.sessions.push_back({});
    for (const double room : {0.0, kApart})
      for (int i = -2; i <= 2; ++i) earlier_.push_back(see({room + 0.5 * i, -0.3, 0, 0.2 * i, 0, 0}, {}, 0.02));
    travel_ = 60;
  }

  /// Adds a key frame with the true pose `truly`. The estimate is `estimated`, or the truth, with `sigma` [m].
  LoopSearch::KeyScan see(const CPose3D& truly, const std::optional<CPose3D>& estimated, double sigma,
                          const World& world = twoRooms()) {
    const CPose3D estimate = estimated.value_or(truly);
    const auto id = run_.addFrame(estimate).id;
    auto& frame = run_.map.key_frames.edit(id);
    const auto scan = scanFrom(truly, world, 5.5);
    auto cloud = mrpt::obs::CObservationPointCloud::Create();
    auto points = mrpt::maps::CSimplePointsMap::Create();
    for (const auto& point : scan->points) points->insertPoint(point.x(), point.y(), 0);
    cloud->pointcloud = points;
    cloud->sensorLabel = kLabel;
    frame.observations.push_back(cloud);
    const auto& first = run_.map.key_frames[0];
    if (id != first.id) {
      run_.graph.addFactor(
          {{first.pose, frame.pose},
           std::make_shared<graph::BetweenSe2>(geometry::project(geometry::fromMrpt(estimate - first.map_from_base))),
           graph::SquareRootInformation::fromSigmas(Eigen::Vector3d(sigma, sigma, 0.05))});
    }
    return {id, scan, travel_ += 0.6};
  }

  mapper::Batch search(std::vector<LoopSearch::KeyScan> newest) {
    run_.uncertainty = mapper::Uncertainty(run_.graph);
    mapper::PluginContext context;
    context.section = "loop_closure";
    const std::shared_ptr<const matching::ScanMatcher> matcher = matching::makeMatcher({});
    const auto places = placesToLoopTo(run_.map, kLabel, earlier_, matcher);
    return GlobalLoopSearch({}, context, matcher, places, kLabel, std::move(newest), earlier_,
                            on_new_ground_)(run_.view());
  }

  testing::HandMadeRun run_;
  double travel_ = 0;
  bool on_new_ground_ = false;
  std::vector<LoopSearch::KeyScan> earlier_;
};

TEST_F(GlobalLoopSearchTest, ACertainButWrongPoseIsFoundInTheOtherRoom) {
  const CPose3D truly(kApart + 0.3, 0.8, 0, 2, 0, 0);
  const auto batch = search({see(truly, CPose3D(0.4, 0.2, 0, 0.5, 0, 0), 0.02)});
  ASSERT_EQ(batch.decisions().size(), 1U);
  EXPECT_TRUE(batch.decisions()[0].accepted) << batch.decisions()[0].reason;
  ASSERT_EQ(batch.addedFactors().size(), 1U);
  const auto& closure = batch.addedFactors()[0];
  EXPECT_TRUE(closure.tags.hypothesis);
  EXPECT_EQ(closure.tags.note, kGlobalClosure);
  const auto& measured = dynamic_cast<const graph::BetweenSe2&>(*closure.factor).measured();
  const auto& place = run_.map.keyFrame(*batch.decisions()[0].to).map_from_base;
  EXPECT_LT(minus(measured, geometry::project(geometry::fromMrpt(truly - place))).norm(), 0.05);
}

TEST_F(GlobalLoopSearchTest, AnUncertainPoseIsFoundToo) {
  const CPose3D truly(kApart + 0.3, 0.8, 0, 2, 0, 0);
  const auto batch = search({see(truly, CPose3D(40, 30, 0, 0, 0, 0), 20)});
  ASSERT_EQ(batch.addedFactors().size(), 1U);
}

TEST_F(GlobalLoopSearchTest, NoSearchWhereTheScanFitsTheMap) {
  const CPose3D truly(kApart + 0.3, 0.8, 0, 2, 0, 0);
  EXPECT_TRUE(search({see(truly, {}, 0.02)}).empty());
}

TEST_F(GlobalLoopSearchTest, OnNewGroundItSearchesOnlyOnRequest) {
  const CPose3D truly(kApart + 0.3, 0.8, 0, 2, 0, 0);
  const auto seen = see(truly, CPose3D(0, 30, 0, 0, 0, 0), 0.02);
  EXPECT_TRUE(search({seen}).empty());
  on_new_ground_ = true;
  EXPECT_EQ(search({seen}).addedFactors().size(), 1U);
}

TEST_F(GlobalLoopSearchTest, ARoomThatWasNeverSeenIsNowhere) {
  World new_room = room(3, 9);
  new_room.push_back({{1.5, 2}, {0.4, 2.6}});
  const auto batch = search({see({0.2, 0.5, 0, 0.4, 0, 0}, CPose3D(0.4, 0.2, 0, 0.5, 0, 0), 0.02, new_room)});
  ASSERT_EQ(batch.decisions().size(), 1U);
  EXPECT_FALSE(batch.decisions()[0].accepted);
  EXPECT_TRUE(batch.addedFactors().empty());
}

}  // namespace
}  // namespace omnimapper::plugins::global_loop_search_test
