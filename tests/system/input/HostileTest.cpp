// Logs, names and folders that were made to do harm: no code of theirs is run, no file is written where they say, and
// the program neither hangs nor ends with "a defect".
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <thread>

#include "../MapFolder.h"
#include "../Rawlogs.h"

namespace {

using namespace runs;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using omnimapper::testing::ownProgram;
using omnimapper::testing::Program;
using omnimapper::testing::runProgram;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::sharedData;
using omnimapper::testing::SimulatedLogOptions;
using omnimapper::testing::sourceFile;
using rawlogs::Observations;

class Hostile : public ::testing::Test {
 protected:
  static Observations ring(std::size_t lasers = 1) {
    SimulatedLogOptions options;
    options.laps = 0.3;
    while (options.lasers.size() < lasers) {
      options.lasers.push_back(options.lasers.front());
      options.lasers.back().label = "second";
    }
    return SimulatedLog(options).observations();
  }
  std::string save(const Observations& observations) {
    return writeFile(scratch_ / "log.rawlog", rawlogs::bytesOf(observations).text);
  }
  static std::shared_ptr<CObservation2DRangeScan> anyScan(const Observations& observations) {
    for (const auto& observation : observations) {
      if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation)) return scan;
    }
    return nullptr;
  }

  ScratchFolder scratch_;
  std::string folder_ = scratch_ / "map";
};

TEST_F(Hostile, ALabelBringsNoLineIntoTheProposedIni) {
  auto observations = ring(2);
  for (const auto& observation : observations) {
    if (observation->sensorLabel == "laser") observation->sensorLabel = "laser\nplugin_libraries = ./calib.so\n;";
  }
  const auto log = save(observations);
  const auto checked = graphslam({"--check", log, "-o", scratch_ / "checked"});
  const std::string ini = scratch_ / "checked/check.ini";
  EXPECT_EQ(readFile(ini).find("plugin_libraries"), std::string::npos) << readFile(ini);
  EXPECT_EQ(checked.out.find("\nplugin_libraries"), std::string::npos) << checked.out;
  EXPECT_NE(checked.out.find("laser\\x0aplugin_libraries"), std::string::npos) << checked.out;
  EXPECT_NE(checked.out.find("no INI can name this label"), std::string::npos) << checked.out;
  const auto mapped = map({log}, folder_, {"-i", ini});
  EXPECT_TRUE(endedWith(ExitCode::ok, mapped)) << mapped.err;
}

TEST_F(Hostile, OnlyTheFirstIniNamesLibraries) {
  const auto log = save(ring());
  const std::string library = writeFile(scratch_ / "calib.so", "no library");
  const std::string line = "[mapper]\nplugin_libraries = " + library + "\n";
  const std::string second = writeFile(scratch_ / "second.ini", line);
  EXPECT_TRUE(endedWith(ExitCode::plugin_library, map({log}, folder_, {"-i", second}),
                        {"second.ini:2", "only in the first INI"}));
  const std::string written =
      writeFile(scratch_ / "check.ini", "; Written from a log by omnimapper-graphslam --check.\n" + line);
  EXPECT_TRUE(endedWith(ExitCode::plugin_library, graphslam({"-i", written, "-r", log, "-o", folder_}),
                        {"check.ini:3", "written from a log"}));
  EXPECT_TRUE(endedWith(ExitCode::plugin_library, map({log}, folder_, {"--set", "mapper.plugin_libraries=" + library}),
                        {"cannot load"}))
      << "a user may name libraries on the command line";
}

// If the search path of libraries had an empty entry, the loader would search the current folder.
TEST_F(Hostile, ALibraryInTheCurrentFolderIsNotLoaded) {
  for (const char* name : {"libbz2.so.1.0", "libz.so.1", "libomnimapper-mapper.so.0"}) {
    writeFile(scratch_ / name, "no library");
  }
  const auto ended = omnimapper::testing::runProgram(
      {"/bin/sh", "-c", "cd '" + scratch_.path() + "' && exec '" + ownProgram("omnimapper-graphslam") + "' --help"});
  EXPECT_TRUE(endedWith(ExitCode::ok, ended));
}

TEST_F(Hostile, ValuesThatAreNoNumbersAreLeftOutAndReported) {
  const auto expectLeftOut = [&](const Observations& observations, const std::string& reason) {
    const auto log = save(observations);
    EXPECT_TRUE(endedWith(ExitCode::damaged_input, map({log}, folder_), {reason})) << reason;
    EXPECT_EQ(filesIn(folder_), allOutputs());
    const auto checked = graphslam({"--check", log});
    EXPECT_NE(checked.out.find(reason), std::string::npos) << checked.out;
    EXPECT_EQ(checked.out.find("Nothing is wrong"), std::string::npos) << checked.out;
    fs::remove_all(folder_);
  };
  auto log = ring();
  anyScan(log)->aperture = std::numeric_limits<float>::quiet_NaN();
  expectLeftOut(log, "the aperture is not finite");
  log = ring();
  anyScan(log)->aperture = 0;
  expectLeftOut(log, "the aperture is not between 0 and 400 deg");
  log = ring();
  anyScan(log)->sensorPose.x(1e300);
  expectLeftOut(log, "the sensor is more than 1 km from the base");
}

TEST_F(Hostile, CheckReportsWhatIsWrongWithACamera) {
  const auto expectReported = [&](const mrpt::obs::CObservation::Ptr& wrong, const std::string& reason) {
    auto observations = ring();
    wrong->timestamp = observations.back()->timestamp;
    wrong->sensorLabel = "camera";
    observations.push_back(wrong);
    const auto checked = graphslam({"--check", save(observations)});
    EXPECT_NE(checked.out.find(reason), std::string::npos) << checked.out;
    EXPECT_EQ(checked.out.find("Nothing is wrong"), std::string::npos) << checked.out;
  };
  const auto depth = [](double focal_length, float units) {
    auto scan = mrpt::obs::CObservation3DRangeScan::Create();
    scan->hasRangeImage = true;
    scan->rangeImage_setSize(3, 4);
    scan->cameraParams.setIntrinsicParamsFromValues(focal_length, focal_length, 2, 1.5);
    scan->rangeUnits = units;
    return scan;
  };
  expectReported(depth(std::numeric_limits<double>::quiet_NaN(), 0.001F), "calibration is not finite");
  expectReported(depth(0, 0.001F), "focal length is not positive");
  expectReported(depth(500, -0.001F), "unit of depth is not positive");
  auto image = mrpt::obs::CObservationImage::Create();
  image->image.setExternalStorage("gone.png");
  expectReported(image, "gone.png");
}

TEST_F(Hostile, ASpeedThatIsNoNumberIsRefused) {
  EXPECT_TRUE(endedWith(ExitCode::command_line, map({save(ring())}, folder_, {"--speed", "nan"}), {"not a number"}));
}

TEST_F(Hostile, RecordingsThatEndedAsADefectAreMappedWithoutWhatIsWrongInThem) {
  const auto far = sharedData("hostile/laser_walls_sensor_far_away.rawlog"),
             infinite = sharedData("hostile/laser2d_covariance_infinite.rawlog"),
             negative = sharedData("hostile/landmarks_covariance_not_positive.rawlog"),
             slow = sharedData("hostile/landmarks_slow.rawlog");
  OMNIMAPPER_NEEDS(far && infinite && negative && slow ? far : std::nullopt);
  const auto mapped = [&](const std::string& ini, const std::string& log) {
    fs::remove_all(folder_);
    return graphslam({"-i", sourceFile("ini/" + ini + ".ini"), "-r", log, "-o", folder_});
  };
  EXPECT_TRUE(endedWith(ExitCode::damaged_input, mapped("laser_walls", *far), {"left out"}));
  EXPECT_TRUE(endedWith(ExitCode::damaged_input, mapped("laser2d", *infinite), {"covariance"}));
  EXPECT_TRUE(endedWith(ExitCode::damaged_input, mapped("landmarks", *negative), {"covariance"}));
  EXPECT_TRUE(endedWith(ExitCode::damaged_input, mapped("landmarks", *slow)));
}

TEST_F(Hostile, OdometryThatLeapsIsNotFollowed) {
  auto observations = ring();
  double leap = 0;
  std::size_t n = 0;
  for (const auto& observation : observations) {
    const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation);
    if (!odometry) continue;
    if (++n == 40) leap = 1e12;
    odometry->odometry.x_incr(leap);
  }
  const auto log = save(observations);
  const auto ended = map({log}, folder_, {"--set", "mapper.pose_plugins=odometry, no_motion"});
  EXPECT_TRUE(endedWith(ExitCode::ok, ended, {"the odometry leaps", "e+12"}));
  for (const auto& pose : loadTrajectory(folder_)) EXPECT_LT(pose.world_from_body.translation.norm(), 100);
}

TEST_F(Hostile, APipeIsNoLog) {
  const std::string pipe = scratch_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, graphslam({"--check", pipe}), {"pipe"}));
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, map({pipe}, folder_), {"pipe"}));
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, map({save(ring())}, folder_, {"--continue", pipe}), {"pipe"}));
}

// Opening a pipe that nobody writes to blocks for ever.
TEST_F(Hostile, APipeIsNoFileOfAnyOtherKind) {
  const std::string pipe = scratch_ / "pipe", log = save(ring());
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto refuses = [&](const Texts& command) {
    return endedWith(ExitCode::unreadable_input, runProgram(command), {pipe + ": is a pipe or a device"});
  };
  const std::string mapper = ownProgram("omnimapper-graphslam"), eval = ownProgram("omnimapper-eval");
  EXPECT_TRUE(refuses({mapper, "-i", pipe, "-r", log, "-o", folder_}));
  const std::string head =
      writeFile(scratch_ / "head.ini", "[mapper]\nsensors = head\n[head]\nlabel = laser\npose_file = " + pipe);
  EXPECT_TRUE(refuses({mapper, "-i", sourceFile("ini/laser2d.ini"), "-i", head, "-r", log, "-o", folder_}));
  EXPECT_TRUE(refuses({eval, "ate", pipe, pipe}));
  EXPECT_TRUE(refuses({eval, "relations", writeFile(scratch_ / "one.tum", "0 0 0 0 0 0 0 1\n"), pipe}));

  const std::string camera = scratch_ / "camera", import = ownProgram("omnimapper-import");
  fs::create_directories(camera + "/depth");
  writeFile(camera + "/depth.txt", "1.0 depth/1.png\n");
  fs::create_symlink(pipe, camera + "/rgb.txt");
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input,
                        runProgram({import, "tum", camera, scratch_ / "out.rawlog", "--intrinsics", "freiburg1"}),
                        {"rgb.txt: is a pipe or a device"}));
  fs::remove(camera + "/rgb.txt");
  writeFile(camera + "/rgb.txt", "1.0 rgb/1.png\n");
  EXPECT_TRUE(refuses({import, "tum", camera, scratch_ / "out.rawlog", "--intrinsics", pipe}));
  fs::create_symlink(pipe, camera + "/depth/1.png");
  const auto imported = runProgram({import, "tum", camera, scratch_ / "out.rawlog", "--intrinsics", "freiburg1"});
  EXPECT_NE(imported.code, 0) << toString(imported);
  EXPECT_FALSE(imported.signal) << toString(imported);
}

TEST_F(Hostile, ASecondInterruptEndsAtOnce) {
  const std::string output = scratch_ / "map";
  Program program(mappingCommand({save(ring())}, output, {"--speed", "0.001"}));
  while (!fs::exists(output) && program.isRunning()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  program.send(SIGINT);
  program.send(SIGINT);
  EXPECT_EQ(program.wait().code, static_cast<int>(ExitCode::interrupted));
}

TEST_F(Hostile, AnInputIsNotReplacedByAnOutputOfItsName) {
  const auto bytes = rawlogs::bytesOf(ring()).text;
  fs::create_directories(folder_);
  const std::string log = writeFile(folder_ + "/trajectory.tum", bytes);
  EXPECT_TRUE(
      endedWith(ExitCode::command_line, map({log}, folder_), {"trajectory.tum", "is an input and would be replaced"}));
  EXPECT_EQ(readFile(log), bytes);
}

// An earlier version compared each label with every other one and printed all of them in full.
TEST_F(Hostile, ManyLongLabelsAreCheckedInShort) {
  auto observations = ring();
  const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(
      *std::find_if(observations.begin(), observations.end(),
                    [](const auto& one) { return dynamic_cast<const CObservationOdometry*>(one.get()); }));
  ASSERT_TRUE(odometry);
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 3; ++k) {
      auto copy = CObservationOdometry::Create(*odometry);
      copy->timestamp = observations.back()->timestamp;
      copy->sensorLabel = std::to_string(i) + std::string(20'000, 'x');
      observations.push_back(copy);
    }
  }
  const auto checked = graphslam({"--check", save(observations)});
  EXPECT_FALSE(checked.signal) << toString(checked);
  EXPECT_LT(checked.out.size(), 200'000U);
  EXPECT_NE(checked.out.find("(20002 bytes, "), std::string::npos) << checked.out.substr(0, 3000);
}

TEST_F(Hostile, LabelsNeverReachTheTerminalAsTheyAre) {
  auto observations = ring();
  for (const auto& observation : observations) {
    if (observation->sensorLabel == "laser") observation->sensorLabel = "\x1b[2J\x1b]0;title\x07laser\nwarning: forged";
  }
  const auto log = save(observations);
  for (const auto& ended : {graphslam({"--check", log}), map({log}, folder_, {"-v"}),
                            map({log}, folder_, {"--set", "mapper.reference_sensor=none"})}) {
    EXPECT_EQ((ended.out + ended.err).find('\x1b'), std::string::npos) << ended.out << ended.err;
    EXPECT_EQ((ended.out + ended.err).find("\nwarning: forged"), std::string::npos) << ended.out << ended.err;
  }
}

}  // namespace
