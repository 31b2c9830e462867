// A run that overwrites the outputs of an older one is killed by kill -9 at any time: each output is complete, in its
// old or its new version, and no temporary files pile up.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::Dice;
using omnimapper::testing::Program;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::SimulatedLogOptions;

constexpr int kKills = 20;

bool isTemporary(const std::string& name) {
  return name.find(".tmp") != std::string::npos;
}

bool isWriting(const std::string& folder) {
  const auto names = filesIn(folder);
  return std::any_of(names.begin(), names.end(), isTemporary);
}

class Crash : public ::testing::Test {
 protected:
  // Maps the log in two versions, which the program reproduces bit for bit.
  Crash() {
    SimulatedLogOptions options;
    options.place = SimulatedLogOptions::Place::box;
    options.laps = 0.5;
    SimulatedLog(options).writeRawlog(log_path_);
    for (const auto& version : versions_) {
      const auto ended = map({log_path_}, scratch_ / version, settingsOf(version));
      EXPECT_TRUE(endedWith(ExitCode::ok, ended));
      seconds_ = ended.seconds;
    }
    fs::copy(scratch_ / versions_[0], folder_);
  }
  static Texts settingsOf(const std::string& version) {
    return {"-q", "--set", version == "coarse" ? "trigger.distance_m=0.8" : "trigger.distance_m=0.3"};
  }
  void expectOneOfBothVersions() {
    for (const char* name : {"map.omnimap", "trajectory.tum", "graph.g2o", "grid.pgm", "points.ply"}) {
      const std::string found = readFile(folder_ + "/" + name);
      EXPECT_TRUE(std::any_of(versions_.begin(), versions_.end(),
                              [&](const auto& v) { return found == readFile(scratch_ / v + "/" + name); }))
          << name << " is neither the old version nor the new one";
    }
    EXPECT_NO_THROW(loadMap(folder_));
  }

  ScratchFolder scratch_;
  const Texts versions_{"coarse", "fine"};
  std::string log_path_ = scratch_ / "box.rawlog", folder_ = scratch_ / "map";
  double seconds_ = 0;
};

TEST_F(Crash, KilledAtAnyTimeTheOutputsAreOneVersionOrTheOtherAndNothingPilesUp) {
  ASSERT_FALSE(readFile(scratch_ / "coarse/map.omnimap") == readFile(scratch_ / "fine/map.omnimap"));
  Dice dice(20);
  int while_writing = 0;
  for (int i = 0; i < kKills; ++i) {
    SCOPED_TRACE("kill number " + std::to_string(i));
    Program program(mappingCommand({log_path_}, folder_, settingsOf(versions_[static_cast<std::size_t>(i) % 2])));
    // One quarter of the kills comes at any time of the run, the others soon after a file is being written.
    double wait = dice.uniform(0, seconds_);
    if (i % 2 == 0 || i % 4 == 1) {
      wait = dice.uniform(0, 0.02);
      const auto leftovers = filesIn(folder_).size();
      while (program.isRunning() && filesIn(folder_).size() == leftovers) std::this_thread::yield();
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(wait));
    program.send(SIGKILL);
    program.wait();
    while_writing += isWriting(folder_);
    expectOneOfBothVersions();
  }
  RecordProperty("killed_while_writing", while_writing);
  ASSERT_TRUE(endedWith(ExitCode::ok, map({log_path_}, folder_, settingsOf("fine"))));
  EXPECT_EQ(filesIn(folder_), allOutputs()) << "temporary files of the killed runs are removed";
  EXPECT_TRUE(readFile(folder_ + "/map.omnimap") == readFile(scratch_ / "fine/map.omnimap"));
}

}  // namespace
