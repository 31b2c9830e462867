#include <bzlib.h>
#include <gtest/gtest.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/RelationError.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/testing/Fixtures.h>

#include <sstream>

#include "Trajectories.h"

namespace omnimapper::eval::relation_error_test {
namespace {

constexpr double kDegree = geometry::kPi / 180;

// Odometry of the FLASER lines of a CARMEN log: the last fields are odom_x odom_y odom_theta ipc_stamp host stamp.
Trajectory odometryOfCarmenLog(const std::string& text) {
  std::vector<StampedPose> poses;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line);
    const std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
    if (words.empty() || words[0] != "FLASER") continue;
    const auto last = words.end();
    poses.push_back({base::parseUnix(*(last - 3)),
                     geometry::lift({std::stod(*(last - 6)), std::stod(*(last - 5)), std::stod(*(last - 4))})});
  }
  return sortedByStamp(poses, "log");
}

std::string unpacked(const std::string& bz2_path) {
  BZFILE* file = BZ2_bzopen(bz2_path.c_str(), "rb");
  std::string text, block(1 << 16, '\0');
  for (int size = 0; file && (size = BZ2_bzread(file, block.data(), static_cast<int>(block.size()))) > 0;) {
    text.append(block, 0, static_cast<std::size_t>(size));
  }
  if (file) BZ2_bzclose(file);
  return text;
}

class RelationFile : public ::testing::Test {
 protected:
  std::string file(const std::string& text) {
    const std::string path = folder_ / "log.relations";
    base::writeFile(path, [&](std::ostream& out) { out << text; });
    return path;
  }
  testing::ScratchFolder folder_;
};

TEST_F(RelationFile, ColumnsAreStampsTranslationRollPitchYaw) {
  const auto relations = readRelations(file("# t1 t2 x y z roll pitch yaw\n90.239599 90.719599 1 2 3 0.1 0.2 0.3\n"));
  ASSERT_EQ(relations.size(), 1u);
  EXPECT_EQ(base::formatUnix(relations[0].from, 6), "90.239599");
  EXPECT_EQ(base::formatUnix(relations[0].to, 6), "90.719599");
  const mrpt::poses::CPose3D expected(1, 2, 3, 0.3, 0.2, 0.1);  // MRPT's order is yaw pitch roll
  EXPECT_LT(minus(relations[0].from_from_to, geometry::fromMrpt(expected)).norm(), 1e-12);
}

TEST_F(RelationFile, ErrorsNameFileAndLine) {
  for (const char* bad : {"1 2 0 0 0 0 0\n", "1 2 0 0 x 0 0 0\n", "1 2 0 0 0 0 0 nan\n", "one 2 0 0 0 0 0 0\n"}) {
    const std::string path = file(std::string("1 2 0 0 0 0 0 0\n") + bad);
    try {
      readRelations(path);
      ADD_FAILURE() << bad;
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      EXPECT_EQ(std::string(error.what()).find(path + ":2: "), 0u) << error.what();
    }
  }
  EXPECT_THROW(readRelations(file("# nothing\n")), base::Error);
  EXPECT_THROW(readRelations(folder_ / "missing"), base::Error);
}

TEST_F(RelationFile, OdometryOfASmallCarmenLogScoresAsWorkedByHand) {
  // Three scans of two beams: ahead by 1 m, then left by 1 m with a turn of 90 deg.
  const Trajectory odometry = odometryOfCarmenLog(
      "# remark\nPARAM robot_frontlaser_offset 0.0 nohost 0\n"
      "ODOM 9 9 9 0 0 0 70.2 nohost 0.1\n"
      "FLASER 2 1.5 1.6 0 0 0 0 0 0 70.200001 nohost 0.1\n"
      "FLASER 2 1.5 1.6 1 0 0 1 0 0 70.300002 nohost 0.2\n"
      "FLASER 2 1.5 1.6 1 1 1.570796327 1 1 1.570796327 70.400003 nohost 0.3\n");
  // First relation: 0.2 m short, right angle. Second: right place, 60 deg instead of 90. Third: no such scan.
  const auto relations =
      readRelations(file("70.200001 70.300002 1.2 0 0 0 0 0\n70.300002 70.400003 0 1 0 0 0 1.047197551\n"
                         "70.200001 70.9 0 0 0 0 0 0\n"));
  const auto error = relationError(odometry, relations);
  EXPECT_EQ(error.missed, 1u);
  EXPECT_EQ(error.translation.count, 2u);
  // Translations 0.2, 0: mean 0.1, std 0.1, max 0.2; squares 0.04, 0: mean 0.02, std 0.02.
  EXPECT_NEAR(error.translation.mean, 0.1, 1e-9);
  EXPECT_NEAR(error.translation.std, 0.1, 1e-9);
  EXPECT_NEAR(error.translation.max, 0.2, 1e-9);
  EXPECT_NEAR(error.squared_translation.mean, 0.02, 1e-9);
  EXPECT_NEAR(error.squared_translation.std, 0.02, 1e-9);
  // Rotations 0, 30 deg: mean 15, std 15; squares 0, 900 deg^2: mean 450.
  EXPECT_NEAR(error.rotation.mean, 15 * kDegree, 1e-8);
  EXPECT_NEAR(error.rotation.std, 15 * kDegree, 1e-8);
  EXPECT_NEAR(error.squared_rotation.mean, 450 * kDegree * kDegree, 1e-8);
  EXPECT_DOUBLE_EQ(error.share_within, 0.5);  // only the first is within 0.5 m and 10 deg
}

TEST(RelationError, IsOfTheSensorWhereTheEstimateIsOfTheBase) {
  // A sensor 1 m ahead of a base that turns left by 90 deg on the spot goes from (1, 0) to (0, 1): seen from its old
  // place 1 m back and 1 m to the left.
  const Trajectory base = {planar(0, 0, 0), planar(1, 0, 0, 90 * kDegree)};
  const std::vector<Relation> relations = {{at(0), at(1), geometry::lift({-1, 1, 90 * kDegree})}};
  RelationOptions options;
  EXPECT_NEAR(relationError(base, relations, options).translation.mean, std::sqrt(2), 1e-12);
  options.base_from_sensor = geometry::lift({1, 0, 0});
  const auto error = relationError(base, relations, options);
  EXPECT_NEAR(error.translation.mean, 0, 1e-12);
  EXPECT_NEAR(error.rotation.mean, 0, 1e-7);
}

TEST(RelationError, StampsMustBeExactUnlessAToleranceIsGiven) {
  const Trajectory estimate = {planar(0, 0, 0), planar(1.004, 1, 0)};
  const std::vector<Relation> relations = {{at(0), at(1), geometry::lift({1, 0, 0})}};
  EXPECT_THROW(relationError(estimate, relations), base::Error);
  RelationOptions options;
  options.tolerance = base::durationFromSeconds(0.005);
  EXPECT_EQ(relationError(estimate, relations, options).missed, 0u);
}

TEST(RelationError, DoesNotDependOnTheEstimatesWorld) {
  const Trajectory walk = randomWalk(60, 8);
  std::vector<Relation> relations;
  for (std::size_t i = 0; i + 7 < walk.size(); ++i) {
    const auto& from = walk[i];
    const auto& to = walk[i + 7];
    relations.push_back({from.stamp, to.stamp, inverse(from.world_from_body) * to.world_from_body});
  }
  const auto truth = relationError(walk, relations);
  EXPECT_LT(truth.translation.max, 1e-9);
  EXPECT_DOUBLE_EQ(truth.share_within, 1);
  const Trajectory noisy = withNoise(walk, 0.1, 9);
  const auto here = relationError(noisy, relations);
  const auto there = relationError(inOtherWorld(someMotion(), noisy), relations);
  EXPECT_GT(here.translation.mean, 0.05);
  EXPECT_NEAR(here.translation.mean, there.translation.mean, 1e-9);
  EXPECT_NEAR(here.rotation.mean, there.rotation.mean, 1e-8);
}

// Published errors of odometry alone on this benchmark: 0.549 +- 2.674 m (at most 18.899), 2.33 +- 6.50 deg.
TEST(RelationError, OfTheOdometryOfAcesIsTheKnownOne) {
  const auto log = testing::sharedData("laser2d/aces.clf.bz2");
  const auto truth = testing::sharedData("laser2d/aces.relations");
  OMNIMAPPER_NEEDS(log && truth ? log : std::nullopt);
  const Trajectory odometry = odometryOfCarmenLog(unpacked(*log));
  EXPECT_EQ(odometry.size(), 7374u);
  const auto error = relationError(odometry, readRelations(*truth));
  EXPECT_EQ(error.translation.count, 1279u);
  EXPECT_EQ(error.missed, 0u);
  EXPECT_NEAR(error.translation.mean, 0.549, 0.0005);
  EXPECT_NEAR(error.translation.std, 2.674, 0.001);
  EXPECT_NEAR(error.translation.max, 18.899, 0.0005);
  EXPECT_NEAR(error.rotation.mean / kDegree, 2.33, 0.005);
  EXPECT_NEAR(error.rotation.std / kDegree, 6.50, 0.005);
}

}  // namespace
}  // namespace omnimapper::eval::relation_error_test
