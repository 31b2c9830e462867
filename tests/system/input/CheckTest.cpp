// omnimapper-graphslam --check prints the result of the check and ends with its exit code, and accepts the INI that the
// check proposes.
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/source/RawlogSource.h>

#include <filesystem>
#include <regex>

#include "../MapFolder.h"
#include "../Rawlogs.h"

namespace {

using namespace runs;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using mrpt::poses::CPose3D;
using omnimapper::testing::mrptDataset;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::sharedData;
using omnimapper::testing::SimulatedLaser;
using omnimapper::testing::SimulatedLogOptions;
using rawlogs::Observations;

class Check : public ::testing::Test {
 protected:
  static Observations ring() {
    SimulatedLogOptions options;
    options.laps = 0.3;
    return SimulatedLog(options).observations();
  }
  /// A log of a laser at the pose `truly`, whose observations state a pose of zero.
  static Observations mounted(const CPose3D& truly) {
    SimulatedLogOptions options;
    options.laps = 0.3;
    options.lasers[0].base_from_sensor = truly;
    auto observations = SimulatedLog(options).observations();
    for (const auto& observation : observations) {
      if (observation->sensorLabel == "laser") observation->setSensorPose(CPose3D());
    }
    return observations;
  }
  std::string save(const Observations& observations) {
    return writeFile(scratch_ / "log.rawlog", rawlogs::bytesOf(observations).text);
  }
  /// Checks the observations, and maps and checks them again with the proposed INI, which both runs must accept.
  void expectRemedy(const Observations& observations, const std::string& remedy) {
    const auto log = save(observations);
    const auto checked = graphslam({"--check", log, "-o", scratch_ / "checked"});
    EXPECT_TRUE(endedWith(ExitCode::doubtful_input, checked)) << checked.out;
    EXPECT_NE(checked.out.find("PROBLEM"), std::string::npos) << checked.out;
    EXPECT_EQ(checked.out, readFile(scratch_ / "checked/check.txt"));
    const std::string ini = scratch_ / "checked/check.ini";
    EXPECT_NE(checked.err.find(ini + " is written."), std::string::npos) << checked.err;
    EXPECT_NE(readFile(ini).find(remedy), std::string::npos) << readFile(ini);
    EXPECT_NE(checked.out.find(readFile(ini)), std::string::npos) << checked.out;
    EXPECT_TRUE(endedWith(ExitCode::ok, map({log}, scratch_ / "map", {"-i", ini})));
    again_ = graphslam({"-i", omnimapper::testing::sourceFile("ini/laser2d.ini"), "-i", ini, "--check", log});
  }

  ScratchFolder scratch_;
  Ended again_;
};

// What only the reader of a format knows.
TEST_F(Check, SaysWhatTheReaderNotesAndDoubts) {
  const std::string folder = scratch_ / "kitchen";
  std::filesystem::create_directories(folder + "/depth");
  constexpr std::uint16_t kTwentyMetres = 20'000;  // [mm]
  const omnimapper::draw::Grey16Image image{8, 6, std::vector<std::uint16_t>(48, kTwentyMetres)};
  for (const char* name : {"0", "1"}) writeFile(folder + "/depth/" + name + ".png", omnimapper::draw::encodePng(image));
  writeFile(folder + "/intrinsics.K.txt", "8 0 3.5\n0 8 2.5\n0 0 1\n");
  const auto ended = graphslam({"--check", folder});
  EXPECT_NE(ended.out.find("/intrinsics.K.txt, fx 8.0 fy 8.0 cx 3.5 cy 2.5 pixels\n"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("\nwarning  half of the depths are above 20.00 m"), std::string::npos) << ended.out;
}

TEST_F(Check, AGoodLogEndsWithZeroAndLeavesNothing) {
  const auto before = filesIn(scratch_.path());
  const auto ended = graphslam({"--check", save(ring())});
  EXPECT_TRUE(endedWith(ExitCode::ok, ended)) << ended.out;
  EXPECT_NE(ended.out.find("Nothing is wrong with the observations"), std::string::npos) << ended.out;
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(filesIn(scratch_.path()).size(), before.size() + 1) << "only the log itself was added";
}

TEST_F(Check, ASensorPoseThatIsWrongIsMendedByTheProposal) {
  expectRemedy(mounted({0.3, 0, 0, 3.14159265, 0, 0}), "pose_yaw_deg = ");
  EXPECT_TRUE(endedWith(ExitCode::ok, again_)) << again_.out;
  expectRemedy(mounted({0.2, 0, 0, 0.8, 0, 0}), "pose_yaw_deg = 4");
  EXPECT_TRUE(endedWith(ExitCode::ok, again_)) << again_.out;
}

TEST_F(Check, OdometryThatIsWorseThanNoneIsLeftOutByTheProposal) {
  auto observations = ring();
  for (const auto& observation : observations) {
    auto* odometry = dynamic_cast<CObservationOdometry*>(observation.get());
    if (odometry) odometry->odometry = mrpt::poses::CPose2D();
  }
  // The list of pose plugins of ini/laser2d.ini without odometry.
  const std::string ini = readFile(omnimapper::testing::sourceFile("ini/laser2d.ini"));
  std::smatch found;
  ASSERT_TRUE(std::regex_search(ini, found, std::regex(R"(pose_plugins\s*= (.*\b)odometry, (.*)\n)"))) << ini;
  expectRemedy(observations, "pose_plugins = " + found.str(1) + found.str(2));
}

// The log also has a tilted laser, which comes first, and an odometry that turns half as far.
TEST_F(Check, OfTwoLasersAndTwoOdometriesTheProposalNamesThoseThatMap) {
  SimulatedLogOptions options;
  options.laps = 0.5;
  SimulatedLaser tilted;
  tilted.label = "a_tilted";
  tilted.base_from_sensor = CPose3D(0.2, 0, 1, 0, 0.6, 0);
  tilted.phase = 0.002;
  options.lasers.push_back(tilted);
  const SimulatedLog log(options);
  Observations observations;
  for (const auto& observation : log.observations()) {
    if (dynamic_cast<const CObservationOdometry*>(observation.get())) {
      auto worse = std::dynamic_pointer_cast<CObservationOdometry>(observation->duplicateGetSmartPtr());
      worse->sensorLabel = "a_worse_one";
      const auto& p = worse->odometry;
      worse->odometry = mrpt::poses::CPose2D(1.5 * p.x(), 0.5 * p.y(), 0.5 * p.phi());
      observations.push_back(worse);
    }
    observations.push_back(observation);
  }
  expectRemedy(observations, "[scan_odometry]\nlabel = laser ");
  const std::string ini = readFile(scratch_ / "checked/check.ini");
  EXPECT_NE(ini.find("odometry_label = odometry "), std::string::npos) << ini;
  EXPECT_LT(errorAgainst(log, loadTrajectory(scratch_ / "map")), 0.05);
}

TEST_F(Check, LogsMayBeNamedByTheOptionOfOtherRunsAndAMapIsNoLog) {
  const auto log = save(ring());
  EXPECT_EQ(graphslam({"-r", log, "--check"}).out, graphslam({"--check", log}).out);
  EXPECT_TRUE(endedWith(ExitCode::command_line, graphslam({"--check"}), {"--check LOG"}));
  writeFile(scratch_ / "map.omnimap", "");
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, graphslam({"--check", scratch_.path()}), {"folder of a map"}));
}

TEST_F(Check, ALogWithoutAnythingToMapHasItsCode) {
  auto observations = ring();
  observations.erase(
      std::remove_if(observations.begin(), observations.end(), [](const auto& o) { return o->sensorLabel == "laser"; }),
      observations.end());
  const auto ended = graphslam({"--check", save(observations)});
  EXPECT_TRUE(endedWith(ExitCode::nothing_to_map, ended)) << ended.out;
  EXPECT_NE(ended.out.find("no 2D scans"), std::string::npos) << ended.out;
}

TEST_F(Check, EveryIniThatItNamesMapsTheLog) {
  const std::vector<std::pair<std::string, Texts>> logs{
      {"rawlogs/home_30s/home_30s.rawlog",
       {"ini/home_planes.ini", "ini/objects_map.ini", "ini/laser2d.ini", "ini/laser_walls.ini"}},
      {"rawlogs/box/box.rawlog", {"ini/laser2d.ini", "ini/laser_walls.ini", "ini/landmarks.ini"}}};
  for (const auto& [name, inis] : logs) {
    const auto log = omnimapper::testing::sourceFile(name);
    const auto checked = graphslam({"--check", log});
    EXPECT_TRUE(endedWith(ExitCode::ok, checked)) << checked.out;
    EXPECT_NE(checked.out.find("No setting of " + inis.front() + " needs to be changed"), std::string::npos)
        << checked.out;
    for (const auto& ini : inis) {
      EXPECT_NE(checked.out.find("\n  " + ini + " "), std::string::npos) << checked.out;
      const auto mapped = graphslam({"-i", omnimapper::testing::sourceFile(ini), "-r", log, "-o", scratch_ / "map"});
      EXPECT_TRUE(endedWith(ExitCode::ok, mapped)) << ini;
      EXPECT_EQ(mapped.err.find("nothing to work on"), std::string::npos) << ini << mapped.err;
    }
  }
}

TEST_F(Check, ARangeCameraWithoutALaserIsMappedByTheProposal) {
  omnimapper::source::RawlogSource source(omnimapper::testing::sourceFile("rawlogs/home_30s/home_30s.rawlog"));
  Observations observations;
  while (const auto observation = source.next()) {
    if (observation->sensorLabel != "laser") observations.push_back(observation);
  }
  const auto log = save(observations);
  const auto checked = graphslam({"--check", log, "-o", scratch_ / "checked"});
  EXPECT_TRUE(endedWith(ExitCode::ok, checked)) << checked.out;
  const auto first = checked.out.find("ini/rgbd_robot.ini"), second = checked.out.find("ini/home_planes.ini");
  EXPECT_TRUE(first < second && second != std::string::npos) << checked.out;
  const auto expectMapped = [&](const Texts& inis) {
    Texts words{"-r", log, "-o", scratch_ / "map"};
    for (const auto& ini : inis) words.insert(words.end(), {"-i", ini});
    const auto mapped = graphslam(words);
    EXPECT_TRUE(endedWith(ExitCode::ok, mapped)) << mapped.out;
    EXPECT_EQ(mapped.err.find("nothing to work on"), std::string::npos) << mapped.err;
  };
  EXPECT_NE(readFile(scratch_ / "checked/check.ini").find("no settings are proposed"), std::string::npos);
  expectMapped({omnimapper::testing::sourceFile("ini/rgbd_robot.ini"), scratch_ / "checked/check.ini"});
  const std::string other = omnimapper::testing::sourceFile("ini/home_planes.ini");
  EXPECT_TRUE(endedWith(ExitCode::ok, graphslam({"-i", other, "--check", log, "-o", scratch_ / "checked"})));
  expectMapped({other, scratch_ / "checked/check.ini"});
  const std::string of_lasers = omnimapper::testing::sourceFile("ini/laser2d.ini");
  EXPECT_EQ(graphslam({"-i", of_lasers, "--check", log}).out, checked.out)
      << "an INI whose plugins measure nothing in the log is not the one that is judged";
}

TEST_F(Check, AnIniThatMeasuresSomethingIsTheOneThatIsJudged) {
  const std::string own = scratch_ / "own.ini";
  writeFile(own, readFile(omnimapper::testing::sourceFile("ini/laser_walls.ini")));
  const auto checked = graphslam({"-i", own, "--check", save(ring())});
  EXPECT_TRUE(endedWith(ExitCode::ok, checked)) << checked.out;
  EXPECT_NE(checked.out.find("No setting of " + own + " needs to be changed"), std::string::npos) << checked.out;
}

TEST_F(Check, ADamagedLogIsJudgedByWhatWasReadable) {
  const auto log = save(ring());
  std::filesystem::resize_file(log, std::filesystem::file_size(log) * 2 / 3 - 7);
  const auto ended = graphslam({"--check", log});
  EXPECT_TRUE(endedWith(ExitCode::damaged_input, ended)) << ended.out;
  EXPECT_NE(ended.out.find("truncated"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("181 beams"), std::string::npos) << ended.out;
}

TEST_F(Check, ALogThatIsNotThereHasItsCode) {
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, graphslam({"--check", scratch_ / "none.rawlog"}), {"none.rawlog"}));
}

/// Real logs without a problem, in which none may be found.
class CheckRecordings : public ::testing::Test {
 protected:
  static void expectNoProblem(const std::string& log) {
    const auto ended = graphslam({"--check", log});
    EXPECT_TRUE(endedWith(ExitCode::ok, ended)) << ended.out;
    EXPECT_LT(std::count(ended.out.begin(), ended.out.end(), '\n'), 40) << "the report must fit on one screen";
  }
};

TEST_F(CheckRecordings, MalagaHasNoProblem) {
  const auto log = mrptDataset("2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog");
  OMNIMAPPER_NEEDS(log);
  expectNoProblem(*log);
}

TEST_F(CheckRecordings, OfficeAndUalHaveNoProblem) {
  for (const char* name : {"laser2d/driving_in_office.rawlog", "laser2d/ual.rawlog"}) {
    const auto log = sharedData(name);
    OMNIMAPPER_NEEDS(log);
    expectNoProblem(*log);
  }
}

TEST_F(CheckRecordings, AcesHasNoSensorPoseButNoProblem) {
  const auto log = sharedData("laser2d/aces.clf.bz2");
  OMNIMAPPER_NEEDS(log);
  const ScratchFolder scratch;
  const std::string rawlog = scratch / "aces.rawlog";
  ASSERT_TRUE(endedWith(
      ExitCode::ok,
      omnimapper::testing::runProgram({omnimapper::testing::ownProgram("omnimapper-import"), "carmen", *log, rawlog})));
  expectNoProblem(rawlog);
  EXPECT_NE(graphslam({"--check", rawlog}).out.find("sensor pose is missing"), std::string::npos);
}

}  // namespace
