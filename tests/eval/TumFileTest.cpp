#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>

#include "Trajectories.h"

namespace omnimapper::eval::tum_file_test {
namespace {

using testing::ScratchFolder;

class TumFile : public ::testing::Test {
 protected:
  std::string file(const std::string& text) {
    const std::string path = folder_ / "trajectory.txt";
    std::filesystem::remove(path);  // a new file is not flushed to the disk, but an existing one that is truncated is
    std::ofstream(path) << text;
    return path;
  }
  // The reader must refuse the text, naming the file, the line and these words.
  void expectRefused(const std::string& text, const std::string& line, const std::string& words) {
    const std::string path = file(text);
    try {
      readTum(path);
      ADD_FAILURE() << "read without complaint: " << text;
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      EXPECT_EQ(std::string(error.what()).find(path + line), 0u) << error.what();
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  ScratchFolder folder_;
};

TEST_F(TumFile, ReadsStampPositionAndQuaternionInThatOrder) {
  // A quarter turn about z: qz = qw = sqrt(1/2).
  const auto trajectory =
      readTum(file("# stamp x y z qx qy qz qw\n\n1305031102.1752999 1 -2 3e-1\t0 0 0.70710678 0.70710678 # here\n"));
  ASSERT_EQ(trajectory.size(), 1u);
  EXPECT_EQ(base::formatUnix(trajectory[0].stamp), "1305031102.1752999");
  const auto& pose = trajectory[0].world_from_body;
  EXPECT_TRUE(pose.translation.isApprox(Eigen::Vector3d(1, -2, 0.3)));
  EXPECT_NEAR(geometry::project(pose).yaw, geometry::kPi / 2, 1e-9);
  EXPECT_NEAR(pose.rotation.norm(), 1, 1e-15);
}

TEST_F(TumFile, SortsByStamp) {
  const auto trajectory = readTum(file("3 3 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 2 0 0 0 0 0 1\n"));
  ASSERT_EQ(trajectory.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(trajectory[i].world_from_body.translation.x(), i + 1);
}

TEST_F(TumFile, ReadsStampsInScientificDecimalsToTheTick) {
  const auto trajectory =
      readTum(file("1.305031102175299883e+09 0 0 0 0 0 0 1\n1305031103e0 0 0 0 0 0 0 1\n13050311041e-1 0 0 0 0 0 0 1\n"
                   "5E2 0 0 0 0 0 0 1\n-2.5e-1 0 0 0 0 0 0 1\n"));
  std::vector<std::string> stamps;
  for (const auto& pose : trajectory) stamps.push_back(base::formatUnix(pose.stamp));
  EXPECT_EQ(stamps, (std::vector<std::string>{"-0.2500000", "500.0000000", "1305031102.1752999", "1305031103.0000000",
                                              "1305031104.1000000"}));
}

TEST_F(TumFile, WhatIsWrittenIsReadBackStampsToTheTick) {
  const Trajectory written = randomWalk(200, 3);
  const std::string path = folder_ / "written.tum";
  writeTum(path, written);
  const Trajectory read = readTum(path);
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].stamp, written[i].stamp);
    EXPECT_LT(minus(read[i].world_from_body, written[i].world_from_body).norm(), 1e-7);
  }
}

TEST_F(TumFile, ErrorsNameFileAndLine) {
  const std::string good = "# remark\n1 0 0 0 0 0 0 1\n";
  expectRefused(good + "2 0 0 0 0 0 0\n", ":3: ", "expected 8 columns (stamp x y z qx qy qz qw), found 7");
  expectRefused(good + "2 0 0 0 0 0 0 1 5\n", ":3: ", "found 9");
  expectRefused(good + "2 0 zero 0 0 0 0 1\n", ":3: ", "column 3, 'zero'");
  expectRefused(good + "2 0 0 nan 0 0 0 1\n", ":3: ", "'nan', is no finite number");
  expectRefused(good + "2 inf 0 0 0 0 0 1\n", ":3: ", "is no finite number");
  expectRefused(good + "2,5 0 0 0 0 0 0 1\n", ":3: ", "column 1");
  expectRefused(good + "nan 0 0 0 0 0 0 1\n", ":3: ", "column 1");
  expectRefused(good + "2 0 0 0 0 0 0 0\n", ":3: ", "unit quaternion");
  expectRefused(good + "2 0 0 0 0 0 0.3 1\n", ":3: ", "unit quaternion");
  expectRefused(good + "3 0 0 0 0 0 0 1\n1.0 0 0 0 0 0 0 1\n", ":4: ", ":2: remove one");
  expectRefused("# nothing\n", ": ", "holds no pose");
}

TEST_F(TumFile, AMissingFileAndAFolderAreRefusedByName) {
  for (const std::string& path : {folder_ / "missing.tum", folder_.path()}) {
    try {
      readTum(path);
      ADD_FAILURE() << path;
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      EXPECT_EQ(std::string(error.what()).find(path), 0u);
    }
  }
}

TEST_F(TumFile, RandomTextIsReadOrRefusedButNeverAnythingElse) {
  std::mt19937 random(11);
  const std::string signs = "0123456789.eE+-naif #\t\n";
  std::uniform_int_distribution<std::size_t> sign(0, signs.size() - 1), column(0, 7);
  int refused = 0;
  for (int round = 0; round < 2000; ++round) {
    std::vector<std::string> columns = {"1", "0", "0", "0", "0", "0", "0", "1"};
    std::string& text = columns[column(random)];
    text.clear();
    for (int i = 0; i < 6; ++i) text += signs[sign(random)];
    std::string line;
    for (const auto& word : columns) line += word + " ";
    try {
      readTum(file(line + "\n"));
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_LT(refused, 2000);
}

TEST_F(TumFile, ReadsGroundTruthOfMrptsSimulatedLogs) {
  const auto trajectory = readMrptGroundTruth(file("1464600320.989009 1.5 -2 3.141593\n1464600321.041046 0 0 -0.5\n"));
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(base::formatUnix(trajectory[0].stamp, 6), "1464600320.989009");
  const auto first = geometry::project(trajectory[0].world_from_body);
  EXPECT_EQ(first.x, 1.5);
  EXPECT_EQ(first.y, -2);
  EXPECT_NEAR(std::abs(first.yaw), geometry::kPi, 1e-6);
  EXPECT_NEAR(geometry::project(trajectory[1].world_from_body).yaw, -0.5, 1e-12);
  EXPECT_THROW(readMrptGroundTruth(file("1 0 0 0 0 0 0 1\n")), base::Error);
}

TEST_F(TumFile, DetectsTheTwoFormatsByTheirColumns) {
  EXPECT_EQ(readTrajectory(file("# a b c\n1 2 0 0\n"))[0].world_from_body.translation.x(), 2);
  EXPECT_EQ(readTrajectory(file("1 3 0 0 0 0 0 1\n"))[0].world_from_body.translation.x(), 3);
  EXPECT_THROW(readTrajectory(file("1 3 0 0 0\n")), base::Error);
}

TEST_F(TumFile, OfAMapsFolderTheTrajectoryIsNamed) {
  writeTum(folder_ / "trajectory.tum", randomWalk(2, 1));
  try {
    readTrajectory(folder_.path());
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("its trajectory is " + std::string(folder_ / "trajectory.tum")),
              std::string::npos)
        << error.what();
  }
}

TEST_F(TumFile, ReadsTheGroundTruthOfMrptsDemos) {
  const auto path = testing::mrptDataset("graphslam-engine-demos/action_observations_map/simul.rawlog.GT.txt");
  OMNIMAPPER_NEEDS(path);
  const auto trajectory = readTrajectory(*path);
  EXPECT_EQ(trajectory.size(), 1734u);
  EXPECT_EQ(base::formatUnix(trajectory.front().stamp, 6), "1464600320.989009");
}

}  // namespace
}  // namespace omnimapper::eval::tum_file_test
