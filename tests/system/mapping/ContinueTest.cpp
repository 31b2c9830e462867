// Logs that are cut in two and continued with --continue: the map is that of the log in one piece, every output shows
// both sessions, and what cannot be continued is refused. If the run is interrupted or killed, the old map stays whole.
#include <mrpt/opengl/COpenGLScene.h>
#include <omnimapper/eval/RelationError.h>
#include <omnimapper/source/RawlogWriter.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "../CutLog.h"
#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::Program;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::sharedData;
using omnimapper::testing::SimulatedLogOptions;

double distanceBetween(const omnimapper::eval::Trajectory& a, const omnimapper::eval::Trajectory& b) {
  return omnimapper::eval::absoluteTrajectoryError(a, b).translation.rmse;
}

// A fixture that also has the map of the whole ring in the folder `whole`, and the map of the first lap continued by
// the second in the folder `both`.
class Continue : public CutRing {
 protected:
  static void SetUpTestSuite() {
    CutRing::SetUpTestSuite();
    ASSERT_TRUE(endedWith(ExitCode::ok, map({file("ring.rawlog")}, file("whole"))));
    continued_ = map({file("b.rawlog")}, file("both"), {"--continue", file("first/map.omnimap")});
    ASSERT_TRUE(endedWith(ExitCode::ok, continued_));
  }
  static Ended goOn(const std::string& from, const std::string& to, Texts more = {}) {
    more.insert(more.end(), {"--continue", from});
    return map({file("b.rawlog")}, to, more);
  }
  static std::string folderWithFirst(const std::string& name) {
    fs::copy(file("first"), file(name));
    return file(name);
  }

  static inline Ended continued_;
};

TEST_F(Continue, TheRingCutInTwoIsTheMapOfTheRingInOnePiece) {
  const auto whole = loadMap(file("whole")), both = loadMap(file("both"));
  ASSERT_EQ(both.map.sessions.size(), 2U);
  EXPECT_TRUE(both.map.sessions[1].aligned);
  EXPECT_EQ(both.map.sessions[1].title, "b");
  EXPECT_NE(continued_.out.find("session 1 was aligned at key frame 1:"), std::string::npos) << continued_.out;
  EXPECT_EQ(continued_.err, "") << "no warning is expected";
  EXPECT_NEAR(static_cast<double>(both.map.key_frames.size()), static_cast<double>(whole.map.key_frames.size()), 2);
  const auto of_whole = loadTrajectory(file("whole")), of_both = loadTrajectory(file("both"));
  EXPECT_EQ(stampsOf(of_both), stampsOf(of_whole));
  const double error = errorAgainst(*log_, of_whole), error_of_both = errorAgainst(*log_, of_both);
  const double apart = distanceBetween(of_both, of_whole);
  RecordProperty("ate_whole_m", std::to_string(error));
  RecordProperty("ate_cut_m", std::to_string(error_of_both));
  RecordProperty("apart_m", std::to_string(apart));
  EXPECT_NEAR(error_of_both, error, 0.02);
  EXPECT_LT(apart, 0.02);
}

TEST_F(Continue, ASessionOfWhichNobodyKnowsWhereItBeginsIsFoundAndAligned) {
  const auto ended = goOn(file("first/map.omnimap"), file("anywhere"), {"--set", "session.start=anywhere"});
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  EXPECT_NE(ended.out.find("session 1 was aligned at key frame 1:"), std::string::npos) << ended.out;
  EXPECT_EQ(ended.err, "") << "no warning is expected";
  EXPECT_LT(distanceBetween(loadTrajectory(file("anywhere")), loadTrajectory(file("whole"))), 0.03);
  EXPECT_NE(readFile(file("anywhere/report.html")).find("relocalization"), std::string::npos);
}

TEST_F(Continue, EveryOutputHasBothSessions) {
  EXPECT_EQ(filesIn(file("both")), allOutputs());
  const auto summary = loadSummary(file("both"));
  ASSERT_EQ(summary["sessions"].size(), 2U);
  EXPECT_TRUE(summary["sessions"][1]["aligned"]);
  EXPECT_NEAR(summary["travel_m"], 2 * log_->lapLength(), 0.02 * log_->lapLength());
  EXPECT_NEAR(summary["log_s"], omnimapper::base::secondsBetween(log_->begin(), log_->end()), 2);
  EXPECT_EQ(summary["warnings"].size(), 0U);
  const std::string report = readFile(file("both/report.html"));
  for (const char* part : {"Sessions", "session 1 was aligned at key frame 1:", "</html>"}) {
    EXPECT_NE(report.find(part), std::string::npos) << part;
  }
  mrpt::opengl::COpenGLScene scene;
  EXPECT_TRUE(scene.loadFromFile(file("both/scene.3Dscene")));
  // The second lap sees the same places, so it adds hardly any cells or points.
  const double cells = static_cast<double>(readFile(file("both/grid.pgm")).size());
  EXPECT_NEAR(cells / static_cast<double>(readFile(file("whole/grid.pgm")).size()), 1, 0.05);
  const double points = static_cast<double>(readFile(file("both/points.ply")).size());
  EXPECT_NEAR(points / static_cast<double>(readFile(file("whole/points.ply")).size()), 1, 0.1);
}

TEST_F(Continue, ASecondTimeItWritesTheSameBytesAndTheFolderNamesTheMap) {
  ASSERT_TRUE(endedWith(ExitCode::ok, goOn(file("first"), file("again"), {"--threads", "3"})));
  EXPECT_TRUE(readFile(file("again/map.omnimap")) == readFile(file("both/map.omnimap")));
}

TEST_F(Continue, IntoTheFolderOfTheOldMapItTakesItsPlace) {
  const std::string folder = folderWithFirst("in_place");
  ASSERT_TRUE(endedWith(ExitCode::ok, goOn(folder, folder)));
  EXPECT_TRUE(readFile(folder + "/map.omnimap") == readFile(file("both/map.omnimap")));
}

TEST_F(Continue, ALogThatStartsFarFromWhereItIsSaidToIsFoundInTheWholeMap) {
  ASSERT_TRUE(endedWith(ExitCode::ok, goOn(file("first"), file("far"),
                                           {"--set", "session.start=pose", "--set", "session.start_x_m=30", "--set",
                                            "session.start_y_m=40"})));
  EXPECT_TRUE(loadSummary(file("far"))["sessions"][1]["aligned"]);
  EXPECT_NEAR(errorAgainst(*log_, loadTrajectory(file("far"))), errorAgainst(*log_, loadTrajectory(file("whole"))),
              0.02);
}

TEST_F(Continue, ALogOfAnotherBuildingStaysUnalignedWithAWarning) {
  SimulatedLogOptions options;
  options.place = SimulatedLogOptions::Place::box;
  SimulatedLog(options).writeRawlog(file("box.rawlog"));
  const auto ended = map({file("box.rawlog")}, file("unaligned"), {"--continue", file("first")});
  EXPECT_TRUE(endedWith(ExitCode::ok, ended, {"session 1 was never aligned", "[session] start", "in another place"}));
  EXPECT_NE(ended.out.find("session 1 was never aligned"), std::string::npos);
  EXPECT_FALSE(loadSummary(file("unaligned"))["sessions"][1]["aligned"]);
  EXPECT_EQ(loadSummary(file("unaligned"))["verdict"]["verdict"], "suspicious");
  const auto before = loadMap(file("first")), after = loadMap(file("unaligned"));
  for (const auto& frame : before.map.key_frames) {
    const auto moved = after.map.keyFrame(frame.id).map_from_base - frame.map_from_base;
    EXPECT_LT(moved.translation().norm(), 1e-3) << frame.id;
  }
}

TEST_F(Continue, AnIniThatCannotAlignALogWithAMapIsRefused) {
  const Texts no_measurements{"--set", "mapper.measurement_plugins="};
  const auto ended =
      map({file("box.rawlog")}, file("none"), {"--continue", file("first"), no_measurements[0], no_measurements[1]});
  EXPECT_TRUE(
      endedWith(ExitCode::command_line, ended, {"it has no plugin that can tie a log to a map", "loop_closure"}));
  EXPECT_FALSE(fs::exists(file("none")));
}

TEST_F(Continue, WhatCannotBeContinuedIsRefusedAndNothingIsWritten) {
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, goOn(file("absent.omnimap"), file("none")), {"absent.omnimap"}));
  const std::string content = readFile(file("first/map.omnimap"));
  writeFile(file("cut.omnimap"), content.substr(0, content.size() / 2));
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, goOn(file("cut.omnimap"), file("none")), {"cut.omnimap"}));
  std::string later = content;
  later[8] = 9;  // the version of the format
  writeFile(file("later.omnimap"), later);
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, goOn(file("later.omnimap"), file("none")), {"format 9"}));
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input,
                        goOn(file("first"), file("none"), {"--set", "mapper.motion=spatial"}), {"planar", "motion"}));
  EXPECT_TRUE(endedWith(ExitCode::wrong_type, goOn(file("first"), file("none"), {"--set", "session.start=here"}),
                        {"start", "end | origin | pose"}));
  EXPECT_FALSE(fs::exists(file("none")));
}

TEST_F(Continue, ALogWithNothingToMapLeavesTheOldMapAsItWas) {
  const std::string folder = folderWithFirst("nothing");
  omnimapper::source::writeRawlog(file("odometry.rawlog"), [&](omnimapper::source::RawlogWriter& writer) {
    for (const auto& observation : log_->observations()) {
      if (observation->sensorLabel == "odometry") writer.add(*observation);
    }
  });
  EXPECT_TRUE(endedWith(ExitCode::nothing_to_map, map({file("odometry.rawlog")}, folder, {"--continue", folder})));
  EXPECT_TRUE(readFile(folder + "/map.omnimap") == readFile(file("first/map.omnimap")));
}

TEST_F(Continue, KilledAtAnyTimeTheOldMapOrTheNewOneIsThere) {
  const std::string folder = folderWithFirst("killed");
  const std::string old_map = readFile(file("first/map.omnimap")), new_map = readFile(file("both/map.omnimap"));
  omnimapper::testing::Dice dice(3);
  for (int i = 0; i < 12; ++i) {
    Program program(mappingCommand({file("b.rawlog")}, folder, {"-q", "--continue", file("first")}));
    std::this_thread::sleep_for(std::chrono::duration<double>(dice.uniform(0, 1.2 * continued_.seconds)));
    program.send(SIGKILL);
    program.wait();
    const std::string found = readFile(folder + "/map.omnimap");
    EXPECT_TRUE(found == old_map || found == new_map) << "kill number " << i;
  }
}

TEST_F(Continue, InterruptedTheOldMapStaysAndTheOtherHasAllOfIt) {
  const std::string folder = folderWithFirst("interrupted");
  Program program(mappingCommand({file("b.rawlog")}, folder, {"--continue", folder, "--speed", "10"}));
  while (program.isRunning() && !program.hasOpen(file("b.rawlog"))) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::duration<double>(1.5));
  program.send(SIGINT);
  EXPECT_TRUE(endedWith(ExitCode::interrupted, program.wait(), {"interrupted"}));
  const auto before = loadMap(file("first")), after = loadMap(folder + "/interrupted");
  EXPECT_EQ(loadMap(folder).map.key_frames.size(), before.map.key_frames.size());
  EXPECT_GT(after.map.key_frames.size(), before.map.key_frames.size());
  EXPECT_LT(after.map.key_frames.size(), loadMap(file("both")).map.key_frames.size());
  for (const auto& frame : before.map.key_frames) EXPECT_TRUE(after.map.key_frames.find(frame.id)) << frame.id;
}

// The errors against the public relations of ACES are as small as those of the log in one piece.
TEST(ContinueRecording, AcesCutInTwoIsAsGoodAsInOnePiece) {
  const auto log = sharedData("laser2d/aces.clf.bz2"), relations = sharedData("laser2d/aces.relations");
  OMNIMAPPER_NEEDS(log && relations ? log : std::optional<std::string>());
  ScratchFolder scratch;
  const std::string whole_log = scratch / "aces.rawlog";
  ASSERT_TRUE(
      endedWith(ExitCode::ok, omnimapper::testing::runProgram(
                                  {omnimapper::testing::ownProgram("omnimapper-import"), "carmen", *log, whole_log})));
  ASSERT_TRUE(endedWith(ExitCode::ok, map({whole_log}, scratch / "whole")));
  const auto of_whole = loadTrajectory(scratch / "whole");
  cutLog(whole_log, of_whole[of_whole.size() / 2].stamp, scratch / "a.rawlog", scratch / "b.rawlog");
  ASSERT_TRUE(endedWith(ExitCode::ok, map({scratch / "a.rawlog"}, scratch / "first")));
  ASSERT_TRUE(
      endedWith(ExitCode::ok, map({scratch / "b.rawlog"}, scratch / "both", {"--continue", scratch / "first"})));
  const auto both = loadMap(scratch / "both");
  EXPECT_TRUE(both.map.sessions.at(1).aligned);
  const auto of_both = loadTrajectory(scratch / "both");
  const auto checked = omnimapper::eval::readRelations(*relations);
  omnimapper::eval::RelationOptions options;
  options.tolerance = omnimapper::base::durationFromSeconds(0.05);
  const auto error = omnimapper::eval::relationError(of_whole, checked, options).translation.mean;
  const auto error_of_both = omnimapper::eval::relationError(of_both, checked, options).translation.mean;
  RecordProperty("apart_m", std::to_string(distanceBetween(of_both, of_whole)));
  RecordProperty("relations_whole_m", std::to_string(error));
  RecordProperty("relations_cut_m", std::to_string(error_of_both));
  EXPECT_LT(error_of_both, 1.2 * error);
}

}  // namespace
