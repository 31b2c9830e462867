// Estimates which way is up in hand-made maps.
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/testing/HandMadeRun.h>

#include "level/estimateLevel.h"

namespace omnimapper::plugins::estimate_level_test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using map::Level;
using mrpt::poses::CPose3D;

constexpr double kDegree = 3.14159265358979323846 / 180;

// A rectangle.
struct Flat : map::LandmarkPayload {
  Flat(const Vector3d& normal, const Vector3d& middle, double side) {
    const Vector3d u = normal.unitOrthogonal() * side / 2, v = normal.cross(u);
    look.normal = normal;
    look.surfaces.push_back({{middle - u - v, middle + u - v, middle + u + v, middle - u + v}});
  }
  std::string_view kind() const override { return "flat"; }
  void write(std::ostream&) const override {}
  map::LandmarkShape shape(const std::vector<Eigen::VectorXd>&, const map::KeyFrames&) const override { return look; }
  map::LandmarkShape look;
};

class EstimateLevel : public ::testing::Test {
 protected:
  // A level base in a place that is turned by `map_from_place`; it looks around.
  void stand(const Quaterniond& map_from_place, double turn_deg = 45) {
    run_.motion = mapper::Motion::spatial;
    map_from_place_ = map_from_place;
    for (int i = 0; i < 8; ++i) {
      const Quaterniond turned = map_from_place * AngleAxisd(turn_deg * i * kDegree, Vector3d::UnitZ());
      run_.addFrame(geometry::toMrpt(geometry::Se3{turned, map_from_place * Vector3d(0, 0, 1)}));
    }
    run_.map.sessions.push_back({0, "first", run_.map.key_frames[0].pose, true});
  }
  void addFlat(const Vector3d& normal, const Vector3d& middle, double side) {
    map::Landmark landmark;
    landmark.evidence = 20;
    landmark.payload = std::make_shared<Flat>(map_from_place_ * normal.normalized(), map_from_place_ * middle, side);
    run_.map.landmarks.add(0, landmark);
  }
  void addRoom() {
    addFlat({0, 0, 1}, {0, 0, 0}, 4);
    addFlat({0, 0, 1}, {1, 0, 0.7}, 1);
    for (const double side : {-1.0, 1.0}) {
      addFlat({side, 0, 0}, {-2 * side, 0, 1}, 3);
      addFlat({0, side, 0}, {0, -2 * side, 1}, 3);
    }
  }
  // Measurements at rest over the time of the key frames; `up` is in the base of the first.
  void addImu(const Vector3d& up) {
    const auto first = run_.map.key_frames.front().stamp, last = run_.map.key_frames.back().stamp;
    // The base turns between key frames about an axis that is up, so that its measured gravity does not change.
    for (int i = 0; i * 0.02 < base::secondsBetween(first, last); ++i) {
      mrpt::obs::CObservationIMU imu;
      imu.sensorLabel = "imu";
      imu.timestamp = first + base::durationFromSeconds(0.02 * i);
      imu.set(mrpt::obs::IMU_X_ACC, 9.81 * up.x());
      imu.set(mrpt::obs::IMU_Y_ACC, 9.81 * up.y());
      imu.set(mrpt::obs::IMU_Z_ACC, 9.81 * up.z());
      evidence_.add(imu);
    }
  }
  void addWheels() {
    mrpt::obs::CObservationOdometry odometry;
    odometry.sensorLabel = "wheels";
    evidence_.add(odometry);
  }
  JudgedLevel estimate() const { return estimateLevel(run_.view(), evidence_, run_.motion); }
  double degreesFromTruth(const Level& level) const {
    const Vector3d up = map_from_place_ * Vector3d::UnitZ();
    return std::atan2(level.up.cross(up).norm(), level.up.dot(up)) / kDegree;
  }

  testing::HandMadeRun run_;
  LevelEvidence evidence_;
  Quaterniond map_from_place_ = Quaterniond::Identity();
};

TEST_F(EstimateLevel, OfAnEmptyMapIsNotKnown) {
  run_.motion = mapper::Motion::spatial;
  const auto judged = estimate();
  EXPECT_FALSE(judged.level.isKnown());
  EXPECT_FALSE(judged.level.reason.empty());
  EXPECT_TRUE(judged.warnings.empty());
}

TEST_F(EstimateLevel, BySurfacesInAMapThatIsTilted) {
  stand(Quaterniond(AngleAxisd(30 * kDegree, Vector3d::UnitX())));
  addRoom();
  const auto level = estimate().level;
  EXPECT_EQ(level.source, Level::Source::planes);
  EXPECT_LT(degreesFromTruth(level), 0.01) << level.reason;
  EXPECT_LT(level.standardDeviation() / kDegree, 1);
}

TEST_F(EstimateLevel, ByGravityWhereThereAreNoSurfaces) {
  stand(Quaterniond(AngleAxisd(30 * kDegree, Vector3d::UnitX())));
  addImu(Vector3d::UnitZ());
  const auto level = estimate().level;
  EXPECT_EQ(level.source, Level::Source::imu) << level.reason;
  EXPECT_LT(degreesFromTruth(level), 0.3) << level.reason;
}

TEST_F(EstimateLevel, WhereGravityAndSurfacesDisagreeGravityCountsAndItIsSaid) {
  stand(Quaterniond::Identity(), 0);
  addRoom();
  addImu({0, std::sin(10 * kDegree), std::cos(10 * kDegree)});
  const auto judged = estimate();
  EXPECT_EQ(judged.level.source, Level::Source::imu);
  ASSERT_EQ(judged.warnings.size(), 1U);
  EXPECT_NE(judged.warnings[0].find("do not agree"), std::string::npos) << judged.warnings[0];
}

TEST_F(EstimateLevel, ByWheelsWhereNothingElseMeasuresIt) {
  stand(Quaterniond::Identity());
  addWheels();
  const auto level = estimate().level;
  EXPECT_EQ(level.source, Level::Source::base);
  EXPECT_LT(degreesFromTruth(level), 1e-6);
  EXPECT_NEAR(level.standardDeviation() / kDegree, 1, 1e-9);
  EXPECT_NE(level.reason.find("'wheels'"), std::string::npos);
}

// The map of a robot does not change in any bit if surfaces differ by about a degree.
TEST_F(EstimateLevel, OfAPlanarMapIsZUnlessSurfacesClearlySayOtherwise) {
  stand(Quaterniond(AngleAxisd(0.8 * kDegree, Vector3d::UnitX())));
  run_.motion = mapper::Motion::planar;
  addRoom();
  addWheels();
  auto judged = estimate();
  EXPECT_EQ(judged.level.source, Level::Source::base);
  EXPECT_EQ(judged.level.up, Vector3d::UnitZ());
  EXPECT_NE(judged.level.reason.find("the up direction by surfaces differs by 0.8 deg"), std::string::npos)
      << judged.level.reason;
  EXPECT_TRUE(judged.warnings.empty());

  run_.map.landmarks = {};
  map_from_place_ = AngleAxisd(8 * kDegree, Vector3d::UnitX());
  addRoom();
  judged = estimate();
  EXPECT_EQ(judged.level.source, Level::Source::planes);
  EXPECT_LT(degreesFromTruth(judged.level), 0.01);
  ASSERT_EQ(judged.warnings.size(), 1U);
  EXPECT_NE(judged.warnings[0].find("the base is not level: by planes it is tilted by 8.0 deg"), std::string::npos)
      << judged.warnings[0];
}

TEST_F(EstimateLevel, OneThatWasMeasuredInAnEarlierSessionCountsOn) {
  stand(Quaterniond::Identity());
  run_.map.layers.set(Level{Level::Source::imu, Vector3d(0, 0.6, 0.8), 1e-4 * Eigen::Matrix3d::Identity(), "before"});
  EXPECT_EQ(estimate().level.source, Level::Source::imu);
  EXPECT_EQ(estimate().level.up, Vector3d(0, 0.6, 0.8));
}

TEST(LevelEvidence, ALaserThatScansALevelPlaneIsARobots) {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.sensorLabel = "front";
  scan.sensorPose = CPose3D(0, 0, 0.3, 0, 0.5, 0);
  LevelEvidence evidence;
  evidence.add(scan);
  EXPECT_EQ(evidence.levelBase(), "");
  scan.sensorPose = CPose3D(0, 0, 0.3, 0, 0, 180 * kDegree);
  evidence.add(scan);
  EXPECT_EQ(evidence.levelBase(), "the 2D laser 'front'");
}

}  // namespace
}  // namespace omnimapper::plugins::estimate_level_test
