#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <filesystem>
#include <functional>

namespace omnimapper::mapper::mapping_run_test {
namespace {

using testing::SimulatedLog;
using testing::SimulatedLogOptions;

SimulatedLogOptions boxLap() {
  SimulatedLogOptions options;
  options.place = SimulatedLogOptions::Place::box;
  return options;
}

// A rawlog of one lap of the box, and runs over it.
class MappingRun : public ::testing::Test {
 protected:
  MappingRun() {
    mapper::loadFeatures();
    log_.writeRawlog(path_);
  }

  RunResult run(
      const std::vector<std::string>& settings = {}, const std::function<bool()>& stop = [] { return false; }) {
    auto config = base::Config::fromText(ini_, "test.ini");
    for (const auto& setting : settings) config.set(setting);
    RunRequest request;
    request.logs = {path_};
    request.output_folder = folder_ / "out";
    base::Progress silent;
    return runMapping(request, config, silent, stop);
  }
  base::Error errorOf(const std::vector<std::string>& settings) {
    try {
      run(settings);
    } catch (const base::Error& error) {
      return error;
    }
    ADD_FAILURE() << "nothing was thrown";
    return {base::ExitCode::ok, ""};
  }

  std::string ini_ = testing::kLaserIni;
  testing::ScratchFolder folder_;
  SimulatedLog log_{boxLap()};
  std::string path_ = folder_ / "box.rawlog";
};

TEST_F(MappingRun, ALogBecomesAMapAndItsMetricsAreReported) {
  const auto result = run();
  EXPECT_EQ(result.code, base::ExitCode::ok);
  EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
  EXPECT_GT(result.key_frames, 30U);
  EXPECT_EQ(result.factors, result.key_frames - 1 + result.closures) << "a link between neighbours, and the closures";
  EXPECT_NEAR(result.travel, log_.lapLength(), 0.5);
  EXPECT_NEAR(result.log_seconds, base::secondsBetween(log_.begin(), log_.end()), 1.5);
  const std::string text = toText(result);
  EXPECT_NE(text.find(std::to_string(result.key_frames)), std::string::npos) << text;
}

TEST_F(MappingRun, FactorsAreOneLinkBetweenNeighboursAndTheClosures) {
  SimulatedLogOptions options;
  options.laps = 1.4;
  SimulatedLog(options).writeRawlog(path_);
  const auto result = run();
  EXPECT_GT(result.closures, 5U);
  EXPECT_EQ(result.factors, result.key_frames - 1 + result.closures);
}

TEST_F(MappingRun, OfATiltedLaserAWarningSaysThatOdometryIsLeftToTheWheels) {
  auto options = boxLap();
  options.lasers.front().base_from_sensor = mrpt::poses::CPose3D(0.2, 0, 0.3, 0, 0.5, 0);
  SimulatedLog(options).writeRawlog(path_);
  const auto result = run();
  EXPECT_EQ(result.code, base::ExitCode::ok);
  EXPECT_EQ(std::count_if(result.warnings.begin(), result.warnings.end(),
                          [](const auto& w) { return w.find("[scan_odometry] ") == 0; }),
            1);
}

TEST_F(MappingRun, ActionsAndFramesGiveTheMapThatObservationsGive) {
  const auto observations = run();
  log_.writeRawlog(path_, SimulatedLog::Format::actions_and_frames);
  const auto frames = run();
  EXPECT_EQ(frames.code, base::ExitCode::ok);
  EXPECT_NEAR(static_cast<double>(frames.key_frames), static_cast<double>(observations.key_frames), 1);
  EXPECT_NEAR(frames.travel, observations.travel, 0.05);
}

TEST_F(MappingRun, ACutLogGivesTheMapOfWhatWasReadable) {
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  const auto result = run();
  EXPECT_EQ(result.code, base::ExitCode::damaged_input);
  EXPECT_FALSE(result.warnings.empty());
  EXPECT_GT(result.key_frames, 10U);
  EXPECT_GT(result.travel, 5);
}

TEST_F(MappingRun, StoppedItGivesTheMapSoFar) {
  int asked = 0;
  const auto result = run({}, [&] { return ++asked > 300; });
  EXPECT_EQ(result.code, base::ExitCode::interrupted);
  EXPECT_GT(result.key_frames, 5U);
  EXPECT_LT(result.travel, 0.8 * log_.lapLength());
  EXPECT_TRUE(std::any_of(result.warnings.begin(), result.warnings.end(),
                          [](const auto& w) { return w.find("interrupted") != std::string::npos; }));
}

TEST_F(MappingRun, ThatAnOlderMapWasReplacedIsSaid) {
  const std::string said = "replaced those of an earlier run";
  EXPECT_EQ(toText(run()).find(said), std::string::npos);
  EXPECT_NE(toText(run()).find(said), std::string::npos);
}

TEST_F(MappingRun, StoppedWhileTheLogIsOpenedItLeavesNothing) {
  try {
    run({}, [] { return true; });
    ADD_FAILURE() << "nothing was thrown";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::interrupted);
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(MappingRun, ALogThatNothingCanBeMappedOfIsAnErrorThatSaysWhatItHolds) {
  auto options = boxLap();
  options.lasers.clear();
  SimulatedLog(options).writeRawlog(path_);
  const auto error = errorOf({});
  EXPECT_EQ(error.code(), base::ExitCode::nothing_to_map);
  EXPECT_NE(std::string(error.what()).find("CObservationOdometry"), std::string::npos) << error.what();
}

TEST_F(MappingRun, MistakesOfTheIniAreErrorsBeforeAnythingIsRead) {
  EXPECT_EQ(errorOf({"mapper.motoin=planar"}).code(), base::ExitCode::unknown_key);
  EXPECT_EQ(errorOf({"mapper.motion=flying"}).code(), base::ExitCode::wrong_type);
  EXPECT_EQ(errorOf({"mapper.window_s=-1"}).code(), base::ExitCode::out_of_range);
  EXPECT_EQ(errorOf({"trigger.distance_m=0"}).code(), base::ExitCode::out_of_range);
  EXPECT_EQ(errorOf({"odometry.class=OdometriePlugin"}).code(), base::ExitCode::unknown_plugin);
  EXPECT_EQ(errorOf({"mapper.plugin_libraries=/no/such.so"}).code(), base::ExitCode::plugin_library);
  EXPECT_EQ(errorOf({"triger.distance_m=1"}).code(), base::ExitCode::unknown_key);
}

TEST_F(MappingRun, WithoutAnyOdometryInTheLogTheUserIsWarned) {
  const std::string null_motion = "[no_motion]\nclass = NoMotionPlugin\n";
  ini_.erase(ini_.find(null_motion), null_motion.size());
  const auto result = run({"mapper.pose_plugins=odometry", "odometry.label=nobody"});
  EXPECT_EQ(result.key_frames, 1U);
  const auto isWarnedOf = [&](const std::string& part) {
    return std::any_of(result.warnings.begin(), result.warnings.end(),
                       [&](const auto& w) { return w.find(part) != std::string::npos; });
  };
  EXPECT_TRUE(isWarnedOf("without a pose"));
  EXPECT_TRUE(isWarnedOf("one key frame"));
}

}  // namespace
}  // namespace omnimapper::mapper::mapping_run_test
