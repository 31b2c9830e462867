#include <gtest/gtest.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <nlohmann/json.hpp>

#include "SensorRun.h"
#include "SmallWorlds.h"

namespace laser3d_test {
namespace {

using namespace omnimapper;
using namespace small_worlds;
using Cloud = mrpt::obs::CObservationPointCloud;

const std::string exact =
    "class = Laser3d\nz_m = 0.7\nnoise_m = 0\nnoise_per_m = 0\nstep_m = 0\ndivergence_deg = 0\nlost = 0\nwhite_range_m "
    "= 0\n"
    "columns = 360\nrings = 5\nlowest_deg = -20\nhighest_deg = 20\n";

sim::World closedRoom() {
  sim::World world = oneRoom(6, 4);
  addQuad(world, "ceiling", sim::SurfaceKind::ceiling, {0, 0, 2.5}, {0, 4, 0}, {6, 0, 0});
  return world;
}

double distanceToSurface(const sim::World& world, int number, const Eigen::Vector3d& point) {
  const auto ref = sim::numberSurfaces(world)[number];
  return std::abs(geometry::signedDistance(world.bodies[ref.body].surfaces[ref.surface].face->plane_in_body, point));
}

TEST(Laser3d, pointsLieOnTheSurfacesTheirTruthNames) {
  const SensorRun run(closedRoom(), sim::Track(at(2, 1.5, 0, 0.4)),
                      exact + "takes_time = false\nlowest_deg = -30\nhighest_deg = 30");
  const auto cloud = run.measure<Cloud>(0);
  ASSERT_EQ(cloud->pointcloud->size(), 1800u);
  const auto truth = nlohmann::json::parse(run.truth(0));
  const geometry::Se3 map_from_sensor = at(2, 1.5, 0.7, 0.4);
  std::size_t i = 0;
  std::set<int> seen;
  for (const auto& run_length : truth["surfaces"]) {
    for (int n = 0; n < run_length[1]; ++n, ++i) {
      float x = 0, y = 0, z = 0;
      cloud->pointcloud->getPoint(i, x, y, z);
      const int number = static_cast<int>(run_length[0]) - 1;
      seen.insert(number);
      EXPECT_LT(distanceToSurface(run.world(), number, map_from_sensor * Eigen::Vector3f(x, y, z).cast<double>()),
                2e-6);
    }
  }
  EXPECT_EQ(i, 1800u);
  EXPECT_EQ(seen.size(), 6u);
}

TEST(Laser3d, eachColumnIsMeasuredAtItsOwnTimeClockwise) {
  const sim::Track track(sim::Track::Kind::motion, {{0, at(2, 2)}, {1, at(4, 2, 0, 0.5)}});
  const SensorRun run(closedRoom(), track, exact + "rate_hz = 5\nrings = 1\nlowest_deg = 0", 0.5);
  const auto cloud = run.measure<Cloud>(1);
  ASSERT_EQ(cloud->pointcloud->size(), 360u);
  for (int column = 0; column < 360; ++column) {
    float x = 0, y = 0, z = 0;
    cloud->pointcloud->getPoint(column, x, y, z);
    EXPECT_NEAR(geometry::wrapToPi(std::atan2(y, x) + column * M_PI / 180), 0, 1e-6);
    const Eigen::Vector3d in_map = *track.at(0.2 + 0.2 * column / 360) * Eigen::Vector3d(x, y, 0.7);
    EXPECT_LT(
        std::min({std::abs(in_map.x()), std::abs(6 - in_map.x()), std::abs(in_map.y()), std::abs(4 - in_map.y())}),
        2e-6);
  }
}

TEST(Laser3d, isOfIntensityAndDropsWhatIsLost) {
  const SensorRun run(closedRoom(), sim::Track(at(2, 1.5)), exact + "lost = 0.2");
  const auto cloud = run.measure<Cloud>(0);
  const auto points = std::dynamic_pointer_cast<mrpt::maps::CPointsMapXYZI>(cloud->pointcloud);
  ASSERT_TRUE(points);
  EXPECT_NEAR(static_cast<double>(points->size()), 1440, 4 * std::sqrt(1800 * 0.16));
  EXPECT_GT(points->getPointIntensity(0), 0.1f);
}

}  // namespace
}  // namespace laser3d_test
