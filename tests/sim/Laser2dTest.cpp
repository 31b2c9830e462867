#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/base/Error.h>

#include <nlohmann/json.hpp>

#include "SensorRun.h"
#include "SmallWorlds.h"

namespace laser2d_test {
namespace {

using namespace omnimapper;
using namespace small_worlds;
using Scan = mrpt::obs::CObservation2DRangeScan;

constexpr double kDegree = M_PI / 180;

// Distance of (x, y) to the nearest wall line of a room of this size.
double distanceToWalls(double x, double y, double width, double depth) {
  return std::min({std::abs(x), std::abs(width - x), std::abs(y), std::abs(depth - y)});
}

double angleOf(const Scan& scan, std::size_t i) {
  const double step = static_cast<double>(scan.aperture) / (static_cast<double>(scan.getScanSize()) - 1);
  return (scan.rightToLeft ? 1 : -1) * (-0.5 * static_cast<double>(scan.aperture) + step * static_cast<double>(i));
}

const std::string ideal = "class = Laser2d\nmodel = ideal\nz_m = 0.5\n";

TEST(Laser2d, idealBeamsEndOnTheWalls) {
  for (int seed = 0; seed < 20; ++seed) {
    sim::Random random(seed, {2});
    const double x = random.uniform(0.5, 5.5), y = random.uniform(0.5, 3.5), yaw = random.uniform(-3, 3);
    const SensorRun run(oneRoom(6, 4), sim::Track(at(x, y, 0, yaw)),
                        ideal + "beams = 720\naperture_deg = 359\nx_m = 0.2\nyaw_deg = 10");
    const auto scan = run.measure<Scan>(0);
    const double sensor_x = x + 0.2 * std::cos(yaw), sensor_y = y + 0.2 * std::sin(yaw);
    for (std::size_t i = 0; i < 720; ++i) {
      ASSERT_TRUE(scan->getScanRangeValidity(i));
      const double angle = yaw + 10 * kDegree + angleOf(*scan, i), range = static_cast<double>(scan->getScanRange(i));
      EXPECT_LT(distanceToWalls(sensor_x + range * std::cos(angle), sensor_y + range * std::sin(angle), 6, 4), 1e-6);
    }
  }
}

TEST(Laser2d, sweepingBeamsEndOnTheWallsFromWhereTheSensorWasThen) {
  const sim::Track turning(sim::Track::Kind::motion, {{0, at(2, 2)}, {1, at(3, 2, 0, 1.5)}});
  const SensorRun run(oneRoom(6, 4), turning, ideal + "sweep_s = 0.1\ncounter_clockwise = false\nrate_hz = 4", 0.9);
  ASSERT_EQ(run.sensor().count(), 4);
  for (int k = 0; k < 4; ++k) {
    const auto scan = run.measure<Scan>(k);
    EXPECT_EQ(scan->timestamp, run.sensor().stampOf(k));
    EXPECT_EQ(scan->sensorLabel, "sensor");
    double late = 0;
    for (std::size_t i = 0; i < scan->getScanSize(); ++i) {
      const double time = 0.25 * k + 0.1 * static_cast<double>(i) / 360,
                   range = static_cast<double>(scan->getScanRange(i));
      const double angle = angleOf(*scan, i);
      const Eigen::Vector3d in_sensor(range * std::cos(angle), range * std::sin(angle), 0);
      const Eigen::Vector3d end = *turning.at(time) * in_sensor, wrong = *turning.at(0.25 * k) * in_sensor;
      EXPECT_LT(distanceToWalls(end.x(), end.y(), 6, 4), 1e-6);
      late = std::max(late, distanceToWalls(wrong.x(), wrong.y(), 6, 4));
    }
    EXPECT_GT(late, 0.05);
  }
}

TEST(Laser2d, truthNamesTheSurfaceOfEachBeam) {
  sim::World world = oneRoom(6, 4);
  world.bodies.erase(world.bodies.begin() + 2);  // no wall in the east
  const SensorRun run(world, sim::Track(at(3, 2)), ideal + "beams = 181\nmax_range_m = 20\ntruth_ranges = true");
  const auto truth = nlohmann::json::parse(run.truth(0));
  const auto refs = sim::numberSurfaces(world);
  int beam = 0, none = 0;
  for (const auto& run_length : truth["surfaces"]) {
    for (int i = 0; i < run_length[1]; ++i, ++beam) {
      const double angle = (beam - 90) * kDegree, y = 2 + 3 * std::tan(angle);
      const int number = run_length[0];
      if (std::abs(y - 2) < 1.999) {
        EXPECT_EQ(number, 0) << beam;
        ++none;
      } else {
        const std::string& name = world.bodies[refs[number - 1].body].name;
        EXPECT_EQ(name, angle < 0 ? "south" : "north") << beam;
        EXPECT_NEAR(truth["ranges"][beam], 2 / std::abs(std::sin(angle)), 2e-6);
      }
    }
  }
  EXPECT_EQ(beam, 181);
  EXPECT_GT(none, 60);
}

TEST(Laser2d, withoutEchoBeamsAreInvalidAndHaveTheRangeAskedFor) {
  const SensorRun run(oneRoom(6, 4), sim::Track(at(3, 2)), ideal + "max_range_m = 2.5");
  const SensorRun zero(oneRoom(6, 4), sim::Track(at(3, 2)), ideal + "max_range_m = 2.5\nno_echo_is_max = false");
  const auto scan = run.measure<Scan>(0);
  EXPECT_FALSE(scan->getScanRangeValidity(180));
  EXPECT_EQ(scan->getScanRange(180), 2.5f);
  EXPECT_EQ(scan->maxRange, 2.5f);
  EXPECT_TRUE(scan->getScanRangeValidity(0));
  EXPECT_EQ(zero.measure<Scan>(0)->getScanRange(180), 0);
}

TEST(Laser2d, rangesAreMultiplesOfTheStep) {
  const SensorRun run(oneRoom(6, 4), sim::Track(at(2.1234, 2)), ideal + "noise_m = 0.02\nstep_m = 0.01");
  const auto scan = run.measure<Scan>(0);
  for (std::size_t i = 0; i < scan->getScanSize(); ++i) {
    const double steps = static_cast<double>(scan->getScanRange(i)) / 0.01;
    EXPECT_NEAR(steps, std::round(steps), 1e-3);
  }
}

TEST(Laser2d, noiseHasTheDeviationOfItsOptions) {
  // Face-on at 3 m: 0.01 + 3 * 0.005.
  const SensorRun run(oneRoom(6, 4), sim::Track(at(3, 2)),
                      ideal + "beams = 3\nnoise_m = 0.01\nnoise_per_m = 0.005\nrate_hz = 100", 40);
  double sum = 0, squares = 0;
  const int count = run.sensor().count();
  for (int k = 0; k < count; ++k) {
    const double error = static_cast<double>(run.measure<Scan>(k)->getScanRange(1)) - 3;
    sum += error, squares += error * error;
  }
  EXPECT_NEAR(sum / count, 0, 4 * 0.025 / std::sqrt(count));
  EXPECT_NEAR(squares / count / (0.025 * 0.025), 1, 4 * std::sqrt(2.0 / count));
}

TEST(Laser2d, aBeamOnAnEdgeIsMixedBetweenItsTwoSides) {
  // A board 1 m ahead whose edge is at y = 0.5, a wall 2 m ahead: a cone of 2 degrees is 35 mm wide at the board.
  sim::World world = oneRoom(4, 4);
  addQuad(world, "board", sim::SurfaceKind::clutter, {3, 0, 0}, {0, 2.5, 0}, {0, 0, 2});
  int between = 0, outside = 0, on_edge = 0;
  for (int i = 0; i < 60; ++i) {
    const double y = 2.0 + 0.002 * (i - 30);
    const SensorRun run(world, sim::Track(at(2, y)),
                        ideal + "beams = 1801\ndivergence_deg = 2\nmixing = 1\nmixing_gap_m = 2");
    const auto scan = run.measure<Scan>(0);
    const auto truth = nlohmann::json::parse(run.truth(0));
    std::vector<int> mixed = truth["mixed"];
    for (std::size_t beam = 1000; beam < 1500; ++beam) {
      const double angle = (static_cast<double>(beam) - 900) * 0.1 * kDegree;
      const double near = 1 / std::cos(angle), far = 2 / std::cos(angle),
                   range = static_cast<double>(scan->getScanRange(beam));
      const bool is_between = range > near + 0.02 && range < far - 0.02;
      const double offset = std::atan2(2.5 - y, 1.0) - angle;  // of the edge from the beam's middle
      if (std::abs(offset) < 0.6 * kDegree && std::sin(angle) * far + y < 3.9) {
        ++on_edge;
        between += is_between;
        EXPECT_EQ(is_between, std::count(mixed.begin(), mixed.end(), static_cast<int>(beam)) == 1);
      } else if (std::abs(offset) > 1.05 * kDegree && std::sin(angle) * far + y < 3.9) {
        outside += is_between;
      }
    }
  }
  EXPECT_GT(on_edge, 400);
  EXPECT_GT(between, 0.95 * on_edge);
  EXPECT_EQ(outside, 0);
}

TEST(Laser2d, withoutMixingAnEdgeBelongsToOneSide) {
  sim::World world = oneRoom(4, 4);
  addQuad(world, "board", sim::SurfaceKind::clutter, {3, 0, 0}, {0, 2.5, 0}, {0, 0, 2});
  const SensorRun run(world, sim::Track(at(2, 2)),
                      ideal + "beams = 1801\ndivergence_deg = 2\nmixing = 0\nmixing_gap_m = 2");
  const auto scan = run.measure<Scan>(0);
  for (std::size_t beam = 1000; beam < 1300; ++beam) {
    const double ahead =
        static_cast<double>(scan->getScanRange(beam)) * std::cos((static_cast<double>(beam) - 900) * 0.1 * kDegree);
    EXPECT_TRUE(std::abs(ahead - 1) < 0.03 || std::abs(ahead - 2) < 0.06) << beam << ": " << ahead;
  }
}

TEST(Laser2d, glassIsSeenFaceOnPassedAslantAndMirrorsWhenGrazed) {
  sim::World world = oneRoom(6, 4);
  sim::Material glass;
  glass.transmission = 0.95f;
  glass.infrared = 0.05f;
  addQuad(world, "pane", sim::SurfaceKind::window, {4, 0, 0}, {0, 4, 0}, {0, 0, 2}, glass);
  const SensorRun run(world, sim::Track(at(3.9, 2)), ideal + "beams = 181\nglass_deg = 6\nrate_hz = 50", 20);
  int seen_at_0 = 0, seen_at_6 = 0, seen_at_40 = 0, mirrored_at_85 = 0, mirrored_at_40 = 0;
  const int count = run.sensor().count();
  for (int k = 0; k < count; ++k) {
    const auto scan = run.measure<Scan>(k);
    const auto isAtPane = [&](int degrees) {
      return std::abs(static_cast<double>(scan->getScanRange(90 + degrees)) * std::cos(degrees * kDegree) - 0.1) < 1e-5;
    };
    seen_at_0 += isAtPane(0), seen_at_6 += isAtPane(6), seen_at_40 += isAtPane(40);
    const std::vector<int> mirrored = nlohmann::json::parse(run.truth(k))["mirrored"];
    mirrored_at_85 += std::count(mirrored.begin(), mirrored.end(), 175) > 0;
    mirrored_at_40 += std::count(mirrored.begin(), mirrored.end(), 130) > 0;
  }
  EXPECT_EQ(seen_at_0, count);
  const double bell = std::exp(-0.5);
  EXPECT_NEAR(seen_at_6, bell * count, 4 * std::sqrt(count * bell * (1 - bell)));
  EXPECT_EQ(seen_at_40, 0);
  EXPECT_GT(mirrored_at_85, 0.7 * count);
  EXPECT_LT(mirrored_at_40, 0.05 * count);
}

TEST(Laser2d, darkSurfacesAreSeenFromNearOnly) {
  const auto rate = [](float infrared, double distance) {
    sim::World world;
    addRoom(world, "room", {-1, -1}, {30, 1});
    sim::Material material;
    material.infrared = infrared;
    addWall(world, "wall", {distance, 1}, {distance, -1}, material);
    const SensorRun run(world, sim::Track(at(0, 0)), ideal + "beams = 3\nwhite_range_m = 10\nrate_hz = 100", 3);
    int seen = 0;
    for (int k = 0; k < run.sensor().count(); ++k) seen += run.measure<Scan>(k)->getScanRangeValidity(1);
    return static_cast<double>(seen) / run.sensor().count();
  };
  EXPECT_EQ(rate(0.9f, 7), 1);
  EXPECT_EQ(rate(0.9f, 13), 0);
  EXPECT_NEAR(rate(0.9f, 10), 0.5, 0.15);
  // With a tenth of the light a wall is measured up to the root of a tenth of the range.
  EXPECT_EQ(rate(0.09f, 2.2), 1);
  EXPECT_EQ(rate(0.09f, 4), 0);
}

TEST(Laser2d, echoesAreLostAtTheRateAskedFor) {
  const SensorRun run(oneRoom(6, 4), sim::Track(at(3, 2)), ideal + "lost = 0.1", 1);
  int lost = 0, count = 0;
  for (int k = 0; k < run.sensor().count(); ++k) {
    const auto scan = run.measure<Scan>(k);
    for (std::size_t i = 0; i < scan->getScanSize(); ++i, ++count) lost += !scan->getScanRangeValidity(i);
  }
  EXPECT_NEAR(lost, 0.1 * count, 4 * std::sqrt(0.09 * count));
}

TEST(Laser2d, aScanDoesNotDependOnTheOrderOfMeasuring) {
  const sim::Track track(sim::Track::Kind::motion, {{0, at(2, 2)}, {1, at(3, 2, 0, 1.5)}});
  const SensorRun run(oneRoom(6, 4), track, "class = Laser2d\nmodel = hokuyo_utm30\nz_m = 0.5", 1);
  const auto ranges = [&](int k) {
    const auto scan = run.measure<Scan>(k);
    std::vector<float> all;
    for (std::size_t i = 0; i < scan->getScanSize(); ++i) all.push_back(scan->getScanRange(i));
    return all;
  };
  std::vector<std::vector<float>> forward, backward;
  for (int k = 0; k < 5; ++k) forward.push_back(ranges(k));
  for (int k = 4; k >= 0; --k) backward.push_back(ranges(k));
  for (int k = 0; k < 5; ++k) EXPECT_EQ(forward[k], backward[4 - k]);
  EXPECT_NE(forward[0], forward[1]);
}

TEST(Laser2d, aModelsFiguresCountWhereNoneAreGiven) {
  const SensorRun run(oneRoom(6, 4), sim::Track(at(3, 2)), "class = Laser2d\nmodel = hokuyo_urg04\nbeams = 100");
  const auto scan = run.measure<Scan>(0);
  EXPECT_EQ(scan->getScanSize(), 100u);
  EXPECT_EQ(scan->maxRange, 4.095f);
  EXPECT_THROW(SensorRun(oneRoom(6, 4), sim::Track(at(3, 2)), "class = Laser2d\nmodel = sick"), base::Error);
  EXPECT_THROW(SensorRun(oneRoom(6, 4), sim::Track(at(3, 2)), "class = Laser2d\nrate_hz = 0"), base::Error);
  EXPECT_THROW(SensorRun(oneRoom(6, 4), sim::Track(at(3, 2)), "class = Laser2d\nbeam = 3"), base::Error);
}

}  // namespace
}  // namespace laser2d_test
