// Ctrl-C and SIGTERM save the map that was made until then.
#include <mrpt/io/CFileGZOutputStream.h>
#include <omnimapper/source/RawlogWriter.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::Program;
using omnimapper::testing::runProgram;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::SimulatedLogOptions;

class Interrupt : public ::testing::TestWithParam<int> {
 protected:
  Interrupt() {
    SimulatedLogOptions options;
    options.place = SimulatedLogOptions::Place::box;
    log_ = std::make_unique<SimulatedLog>(options);
    log_->writeRawlog(log_path_);
  }
  /// Writes the log again with a pause of a day after the observation with that number.
  void pauseAfter(std::size_t count) {
    auto observations = log_->observations();
    for (std::size_t i = count; i < observations.size(); ++i)
      observations[i]->timestamp += omnimapper::base::durationFromSeconds(86400);
    omnimapper::source::writeRawlog(log_path_, [&](omnimapper::source::RawlogWriter& writer) {
      for (const auto& observation : observations) writer.add(*observation);
    });
  }
  /// Starts the program, which replays the log at ten times its pace, and waits until it waits for the end of the
  /// pause.
  std::unique_ptr<Program> replayedUntilThePause() {
    auto program = std::make_unique<Program>(mappingCommand({log_path_}, folder_, {"--speed", "10"}));
    const std::string staged = folder_ + "/.omnimapper/staged";
    while (!fs::exists(staged) && program->isRunning()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(program->waitUntilIdle());
    return program;
  }

  ScratchFolder scratch_;
  std::unique_ptr<SimulatedLog> log_;
  std::string log_path_ = scratch_ / "box.rawlog", folder_ = scratch_ / "map";
};

TEST_P(Interrupt, WhileReplayingSavesTheMapSoFar) {
  pauseAfter(log_->observations().size() / 2);
  const auto program = replayedUntilThePause();
  program->send(GetParam());
  EXPECT_TRUE(endedWith(ExitCode::interrupted, program->wait(), {"interrupted"}));
  EXPECT_EQ(filesIn(folder_), allOutputs());
  EXPECT_GT(loadMap(folder_).map.key_frames.size(), 2U);
  const auto found = stampsOf(loadTrajectory(folder_)), scans = scanStamps(*log_);
  ASSERT_GT(found.size(), 20U);
  EXPECT_LT(found.size(), scans.size());
  EXPECT_TRUE(std::equal(found.begin(), found.end(), scans.begin())) << "all scans up to the signal";
}

TEST_P(Interrupt, OverAnOlderMapLeavesThatAndKeepsItsOwnElsewhere) {
  ASSERT_TRUE(endedWith(ExitCode::ok, map({log_path_}, folder_)));
  const auto before = contentsOf(folder_);
  pauseAfter(log_->observations().size() / 2);
  const auto program = replayedUntilThePause();
  program->send(GetParam());
  EXPECT_TRUE(endedWith(ExitCode::interrupted, program->wait(), {"is unchanged", folder_ + "/interrupted"}));
  EXPECT_EQ(filesIn(folder_ + "/interrupted"), allOutputs());
  EXPECT_LT(loadMap(folder_ + "/interrupted").map.key_frames.size(), loadMap(folder_).map.key_frames.size());
  EXPECT_EQ(contentsOf(folder_), before);
  ASSERT_TRUE(endedWith(ExitCode::ok, map({log_path_}, folder_)));
  EXPECT_EQ(filesIn(folder_), allOutputs()) << "a complete run removes the outputs of an interrupted one";
}

TEST_P(Interrupt, WhileWaitingForAPauseOfTheLogDoesNotWaitForItsEnd) {
  pauseAfter(1);
  const auto program = replayedUntilThePause();
  program->send(GetParam());
  EXPECT_TRUE(endedWith(ExitCode::interrupted, program->wait(), {"nothing to map"})) << "no scan was read yet";
}

TEST_P(Interrupt, WhileTheLogIsCheckedEndsAndLeavesNothing) {
  // Appends 10 GB of zeros to the log, compressed to a few MB, so that the check takes many times as long as it takes
  // to send the signal.
  const std::string zeros_path = scratch_ / "zeros";
  {
    mrpt::io::CFileGZOutputStream zeros(zeros_path);
    const std::vector<char> megabyte(1000000);
    for (int i = 0; i < 50; ++i) zeros.Write(megabyte.data(), megabyte.size());
  }
  std::ofstream log(log_path_, std::ios::binary | std::ios::app);
  for (int i = 0; i < 200; ++i) log << readFile(zeros_path);
  log.close();
  Program program(mappingCommand({log_path_}, folder_));
  while (!program.hasOpen(log_path_) && program.isRunning()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  program.send(GetParam());
  EXPECT_TRUE(endedWith(ExitCode::interrupted, program.wait(), {"interrupted", log_path_}));
  EXPECT_FALSE(fs::exists(folder_));
}

// The outputs are complete, and reported, while the window still shows the map.
TEST_P(Interrupt, OfAWindowThatShowsAWholeMapCutsNothingShort) {
  if (!endedWith(ExitCode::ok, runProgram({"which", "xvfb-run"})))
    GTEST_SKIP() << "there is no xvfb-run (package xvfb)";
  const std::string said = scratch_ / "said";
  const std::string script = R"(said=$1 signal=$2; shift 2
"$@" >"$said" 2>&1 & program=$!
while kill -0 $program && ! grep -q 'close it to end' "$said"; do sleep 0.1; done
kill -"$signal" $program
wait $program)";
  Texts command = {"xvfb-run", "-a", "bash", "-c", script, "bash", said, std::to_string(GetParam())};
  for (const auto& word : mappingCommand({log_path_}, folder_, {"--gui"})) command.push_back(word);
  EXPECT_TRUE(endedWith(ExitCode::ok, runProgram(command)));
  const std::string text = readFile(said);
  const auto verdict = text.find("verdict "), outputs = text.find("outputs "), window = text.find("close it to end");
  EXPECT_TRUE(verdict < outputs && outputs < window && window != std::string::npos) << text;
  EXPECT_EQ(text.find("interrupted"), std::string::npos) << text;
  EXPECT_EQ(text.find("outputs ", window), std::string::npos) << "reported once:\n" << text;
  EXPECT_EQ(filesIn(folder_), allOutputs());
}

TEST_P(Interrupt, OfAnImportLeavesNoRawlog) {
  const std::string input = scratch_ / "long.clf", folder = scratch_ / "out";
  fs::create_directory(folder);
  std::string line = "FLASER 180";
  for (int i = 0; i < 180; ++i) line += " 2.55";
  std::string lines;
  for (int i = 0; i < 40'000; ++i) {
    const std::string stamp = std::to_string(1e9 + 0.1 * i);
    lines += line + " 0 0 0 0 0 0 " + stamp + " host " + stamp + "\n";
  }
  writeFile(input, lines);
  Program program({omnimapper::testing::ownProgram("omnimapper-import"), "carmen", input, folder + "/long.rawlog"});
  while (filesIn(folder).empty() && program.isRunning()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  program.send(GetParam());
  EXPECT_TRUE(endedWith(ExitCode::interrupted, program.wait(), {"no rawlog was written"}));
  EXPECT_TRUE(filesIn(folder).empty());
}

INSTANTIATE_TEST_SUITE_P(Signals, Interrupt, ::testing::Values(SIGINT, SIGTERM),
                         [](const auto& signal) { return signal.param == SIGINT ? "CtrlC" : "Terminate"; });

}  // namespace
