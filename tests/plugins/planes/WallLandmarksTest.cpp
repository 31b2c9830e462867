#include <omnimapper/base/Error.h>
#include <omnimapper/plane_factors/PlaneParametrization.h>
#include <omnimapper/testing/MapperRun.h>

#include "SurfaceRun.h"

namespace omnimapper::plugins::wall_landmarks_test {
namespace {

using namespace surface_run;

class WallLandmarks : public SurfaceRun {
 protected:
  static PlaneLandmarksOptions walls() {
    PlaneLandmarksOptions options;
    options.form = PlaneLandmarksOptions::Form::wall;
    return options;
  }
  WallLandmarks() : SurfaceRun(walls()) {}
};

TEST_F(WallLandmarks, HaveTwoDegreesOfFreedomAndNoPrior) {
  driveTo({});
  see(linesOf({line({3, -2}, {3, 2}), line({-2, 3}, {2, 3})}));
  driveTo({0.5, 0, 0, 0.2, 0, 0});
  const geometry::Se2 base_from_map = inverse(geometry::Se2{0.5, 0, 0.2});
  see(linesOf({line(base_from_map * Vector2d(3, -1), base_from_map * Vector2d(3, 2.5))}));
  ASSERT_EQ(active().size(), 2U);
  EXPECT_EQ(run_.graph.variable(active()[0].variables[0]).kind->kind(), "wall");
  EXPECT_EQ(factorsOfKind("wall_from_se2"), 3U);
  EXPECT_EQ(run_.graph.factors().size(), 4U);  // and the odometry
  const auto [from, to] = shapeOf(active()[0]).lines.at(0);
  EXPECT_NEAR((to - from).norm(), 4.5, 1e-6);
  EXPECT_FALSE(plugin_->wants(planesOf({})));
}

TEST_F(WallLandmarks, AreNotForMapsInSpace) {
  run_.motion = mapper::Motion::spatial;
  EXPECT_THROW(make(walls()), base::Error);
}

// A drive through a simulated box: its four walls, and a trajectory better than odometry's.
TEST(WallLandmarksDrive, MapTheFourWallsOfABox) {
  const std::string ini = R"(
[mapper]
pose_plugins        = odometry
measurement_plugins = walls
solve_every         = 10
[perception]
extractors = lines
[odometry]
class = OdometryPlugin
[lines]
class = LaserLineExtractor
[walls]
class = PlaneLandmarksPlugin
form  = wall
)";
  testing::SimulatedLogOptions options;
  options.place = testing::SimulatedLogOptions::Place::box;
  const testing::SimulatedLog log(options);
  const auto engine = testing::makeEngine(ini);
  testing::run(*engine, log.observations());
  const auto view = engine->view();
  std::size_t walls = 0;
  for (const auto& [id, landmark] : view.map.landmarks)
    walls += landmark.state == map::Landmark::State::active && landmark.evidence > 5;
  EXPECT_EQ(walls, 4U);
  EXPECT_LT(testing::trajectoryError(view, log), 0.03);
}

}  // namespace
}  // namespace omnimapper::plugins::wall_landmarks_test
