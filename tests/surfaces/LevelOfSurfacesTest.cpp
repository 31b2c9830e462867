// Direction of up by surfaces, in rooms of a few planes computed by hand.
#include <gtest/gtest.h>
#include <omnimapper/surfaces/levelOfSurfaces.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace omnimapper::surfaces::level_test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kDegree = 3.14159265358979323846 / 180;

struct Place {
  std::vector<FlatArea> areas;
  std::vector<Viewpoint> viewpoints;

  void add(const Vector3d& normal, const Vector3d& middle, double area) {
    areas.push_back({normal.normalized(), middle, area, 20});
  }
  // In the middle of the place, 1.2 m high, in eight directions, each pitched down by 20 deg.
  void lookAround(double roll = 0) {
    for (int i = 0; i < 8; ++i) {
      const Quaterniond turn = AngleAxisd(45 * i * kDegree, Vector3d::UnitZ()) *
                               AngleAxisd(20 * kDegree, Vector3d::UnitY()) * AngleAxisd(roll, Vector3d::UnitX());
      viewpoints.push_back({{0.1 * i, 0, 1.2}, turn * Vector3d::UnitZ(), turn * Vector3d::UnitX()});
    }
  }
  void turn(const Quaterniond& by) {
    for (auto& area : areas) {
      area.normal = by * area.normal;
      area.middle = by * area.middle;
    }
    for (auto& viewpoint : viewpoints) viewpoint = {by * viewpoint.position, by * viewpoint.up, by * viewpoint.forward};
  }
  SurfacesLevel level() const { return levelOfSurfaces(areas, viewpoints); }
};

// 4 by 6 m, with a table and a seat; no ceiling is seen.
Place room() {
  Place place;
  place.add({0, 0, 1}, {0, 0, 0}, 20);
  place.add({0, 0, 1}, {1, 1, 0.74}, 1.2);
  place.add({0, 0, 1}, {1, 2, 0.45}, 0.5);
  place.add({-1, 0, 0}, {2, 0, 1.2}, 12);
  place.add({1, 0, 0}, {-2, 0, 1.2}, 12);
  place.add({0, -1, 0}, {0, 3, 1.2}, 8);
  place.add({0, 1, 0}, {0, -3, 1.2}, 8);
  return place;
}

double degreesFrom(const SurfacesLevel& level, const Vector3d& up) {
  return level.up ? std::atan2(level.up->cross(up).norm(), level.up->dot(up)) / kDegree : 999;
}

TEST(LevelOfSurfaces, OfARoomIsFoundHoweverItsFrameIsTurned) {
  for (const double tilt : {0.0, 30.0, 90.0, 150.0, 180.0}) {
    auto place = room();
    place.lookAround();
    const Quaterniond by(AngleAxisd(tilt * kDegree, Vector3d(1, 0.3, -0.2).normalized()));
    place.turn(by);
    const auto level = place.level();
    EXPECT_LT(degreesFrom(level, by * Vector3d::UnitZ()), 0.01) << tilt << ": " << level.reason;
    EXPECT_GT(level.margin, 4) << tilt;
  }
}

TEST(LevelOfSurfaces, ACameraMountedUpsideDownIsFoundByFloorAndTables) {
  auto place = room();
  place.lookAround(180 * kDegree);
  const auto level = place.level();
  EXPECT_LT(degreesFrom(level, Vector3d::UnitZ()), 0.01) << level.reason << level.margin;
}

TEST(LevelOfSurfaces, ASlopedFloorAmongWallsIsNotTakenForLevel) {
  Place place = room();
  place.areas.erase(place.areas.begin() + 1, place.areas.begin() + 3);
  place.areas[0].normal = Vector3d(std::sin(8 * kDegree), 0, std::cos(8 * kDegree));
  place.lookAround();
  const auto level = place.level();
  EXPECT_LT(degreesFrom(level, Vector3d::UnitZ()), 0.3) << level.reason;
}

// Both walls, the floor and the ceiling are the same from end to end.
TEST(LevelOfSurfaces, OfALongCorridorIsNotAlongIt) {
  Place place;
  place.add({0, 0, 1}, {15, 0, 0}, 60);
  place.add({0, 0, -1}, {15, 0, 2.5}, 60);
  place.add({0, -1, 0}, {15, 1, 1.25}, 75);
  place.add({0, 1, 0}, {15, -1, 1.25}, 75);
  for (int i = 0; i < 30; ++i) place.viewpoints.push_back({{1.0 * i, 0, 1.2}, {0, 0, 1}, {1, 0, 0}});
  const auto level = place.level();
  EXPECT_LT(degreesFrom(level, Vector3d::UnitZ()), 0.01) << level.reason;
}

TEST(LevelOfSurfaces, OfOneWallIsNotKnown) {
  Place place;
  place.add({-1, 0, 0}, {2, 0, 1.2}, 12);
  for (int i = 0; i < 5; ++i) place.viewpoints.push_back({{0, 0.2 * i, 1.2}, {0, 0, 1}, {1, 0, 0}});
  const auto level = place.level();
  EXPECT_FALSE(level.up) << level.reason;
  EXPECT_FALSE(level.reason.empty());
}

TEST(LevelOfSurfaces, OfAFloorAloneSeenFromAboveIsItsNormal) {
  Place place;
  place.add({0, 0, 1}, {1.2, 0, 0}, 3);
  const double pitch = 45 * kDegree;
  for (int i = 0; i < 5; ++i)
    place.viewpoints.push_back(
        {{0, 0.2 * i, 1.2}, {std::sin(pitch), 0, std::cos(pitch)}, {std::cos(pitch), 0, -std::sin(pitch)}});
  EXPECT_LT(degreesFrom(place.level(), Vector3d::UnitZ()), 0.01);
}

TEST(LevelOfSurfaces, OfNothingIsNotKnown) {
  EXPECT_FALSE(levelOfSurfaces({}, {}).up);
  EXPECT_EQ(levelOfSurfaces({}, {}).reason, "no surfaces were seen");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Place place;
  place.areas.push_back({{nan, 0, 1}, {0, 0, 0}, 3, 2});
  place.areas.push_back({{0, 0, 1}, {0, 0, 0}, nan, 2});
  place.areas.push_back({{0, 0, 2}, {0, 0, 0}, 3, 2});
  place.areas.push_back({{0, 0, 1}, {0, 0, 0}, 3, 0});
  place.viewpoints.push_back({{nan, 0, 0}, {0, 0, 1}, {1, 0, 0}});
  EXPECT_FALSE(place.level().up);
}

// Surfaces are off by what sigmaOf() expects: half a degree, and 2 deg in a view.
TEST(LevelOfSurfaces, StatedUncertaintyHolds) {
  std::uint32_t state = 7;
  const auto uniform = [&] {
    state = state * 1664525u + 1013904223u;
    return state / 4294967296.0;
  };
  const auto gaussian = [&] {
    return std::sqrt(-2 * std::log(uniform() + 1e-12)) * std::cos(2 * 3.14159265358979323846 * uniform());
  };
  constexpr int kRuns = 200;
  double sum = 0;
  for (int run = 0; run < kRuns; ++run) {
    auto place = room();
    place.lookAround();
    for (auto& area : place.areas) {
      const Vector3d off = 0.6 * kDegree * Vector3d(gaussian(), gaussian(), gaussian());
      area.normal = AngleAxisd(off.norm(), off.normalized()) * area.normal;
    }
    const auto level = place.level();
    ASSERT_TRUE(level.up);
    const Eigen::Vector2d error = level.up->cross(Vector3d::UnitZ()).head<2>();
    const Eigen::Matrix2d covariance = level.covariance.topLeftCorner<2, 2>();
    sum += error.dot(covariance.inverse() * error) / 2;
  }
  EXPECT_GT(sum / kRuns, 0.4);
  EXPECT_LT(sum / kRuns, 1.5) << "a consistent estimate has 1";
}

}  // namespace
}  // namespace omnimapper::surfaces::level_test
