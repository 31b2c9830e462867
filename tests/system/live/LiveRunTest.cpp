#include <omnimapper/live/HostClock.h>
#include <omnimapper/live/Journal.h>
#include <omnimapper/map/Labels.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/obs/CommandTable.h>
#include <omnimapper/source/RawlogSource.h>

#include "LiveRun.h"

// A robot that drives through a room for 27 s is mapped meanwhile, from its laser by MRPT's driver and its odometry.
namespace {

using namespace runs;
using omnimapper::testing::Program;
using omnimapper::testing::runProgram;
using omnimapper::testing::sourceFile;
using std::chrono::milliseconds;

const std::string kBox = sourceFile("rawlogs/box/box.rawlog"), kTruth = sourceFile("rawlogs/box/truth.tum");
constexpr std::size_t kScans = 268, kOdometry = 536;  // in the log

void sleep(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

// Runs the mapper until the player has played the whole log.
Ended playAndMap(LiveRun& run, const Texts& more = {}, const ProgramOptions& options = {}) {
  run.play(kBox, kTruth);
  Program mapper(run.live(more), options);
  run.player->wait();
  sleep(0.5);
  mapper.send(SIGINT);
  return mapper.wait();
}

TEST(LiveRun, isAsGoodAsTheRecordingMappedOffline) {
  LiveRun run(12);
  const auto ended = playAndMap(run);
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  const auto summary = run.summary().at("live");
  EXPECT_EQ(summary.at("arrived"), kScans + kOdometry);
  EXPECT_EQ(summary.at("given"), kScans + kOdometry);
  EXPECT_EQ(summary.at("dropped"), 0);
  EXPECT_EQ(summary.at("recording").at("observations"), kScans + kOdometry);
  EXPECT_LE(summary.at("latency_s").at("median"), summary.at("latency_s").at("99_percent"));
  EXPECT_FALSE(fs::exists(run.out() + "/checkpoint.omnimap")) << "the map itself has replaced it";

  const auto offline = run.folder / "offline";
  ASSERT_TRUE(endedWith(ExitCode::ok, map({run.recorded(".rawlog")}, offline)));
  const double live_error = errorOf(run.out() + "/trajectory.tum", run.folder / "truth.tum");
  const double offline_error = errorOf(offline + "/trajectory.tum", run.folder / "truth.tum");
  EXPECT_LE(live_error, 1.2 * offline_error + 0.003) << "offline " << offline_error;

  // Replays with the INI of the run, which is beside the journal.
  const auto again = run.folder / "again";
  const auto replayed = graphslam({"--replay", run.out(), "-o", again});
  ASSERT_TRUE(endedWith(ExitCode::ok, replayed));
  EXPECT_EQ(replayed.err.find("settings"), std::string::npos) << replayed.err;
  EXPECT_EQ(readFile(again + "/map.omnimap"), readFile(run.out() + "/map.omnimap"));

  EXPECT_TRUE(endedWith(ExitCode::unwritable_output, graphslam({"--replay", run.out(), "-o", run.out()}),
                        {"that run is the live run that is replayed"}));

  const auto other = runProgram(run.command({"--replay", run.recorded(".journal"), "-o", run.folder / "other", "--set",
                                             "trigger.distance_m=0.2", "--set", "trigger.angle_deg=5"}));
  EXPECT_TRUE(endedWith(
      ExitCode::ok, other,
      {"this run departs from the live run", "[trigger] angle_deg (5, was 25), [trigger] distance_m (0.2, was 0.6)"}));

  // A recording may come from anybody, so its INI must not be able to load libraries.
  std::ofstream(omnimapper::live::iniOf(run.recorded(".journal"))) << "[mapper]\nplugin_libraries = theirs.so\n";
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, graphslam({"--replay", run.out(), "-o", run.folder / "theirs"}),
                        {"no live run wrote this INI"}));
}

TEST(LiveRun, ofAMapperThatIsKilledTheRecordingStays) {
  LiveRun run(2);
  run.play(kBox);
  Program mapper(run.live({"--set", "live.checkpoint_s=1"}));
  while (mapper.isRunning() && run.recorded(".journal").empty()) sleep(0.01);
  while (mapper.isRunning() && !fs::exists(run.out() + "/checkpoint.omnimap")) sleep(0.01);
  // A block may be under way now. What came before is on the disk after the next two.
  const auto before = omnimapper::live::hostNow();
  for (int block = 0; block < 3; ++block) {
    const auto size = fs::file_size(run.recorded(".rawlog"));
    while (run.player->isRunning() && fs::file_size(run.recorded(".rawlog")) == size) sleep(0.01);
  }
  const bool still_plays = run.player->isRunning();  // unless this program had no core for some seconds
  mapper.send(SIGKILL);
  mapper.wait();
  omnimapper::source::RawlogSource recorded(run.recorded(".rawlog"));
  omnimapper::base::Stamp last;
  while (const auto observation = recorded.next()) last = observation->timestamp;
  if (still_plays) {
    EXPECT_GE(last, before);
  }
  const auto again = run.folder / "again";
  ASSERT_TRUE(endedWith(ExitCode::ok, runProgram(run.command({"--replay", run.recorded(".journal"), "-o", again}))));
  EXPECT_GT(nlohmann::json::parse(std::ifstream(again + "/summary.json")).at("key_frames"), 3);
  // Another run does not replace the checkpoint, and a map can be continued from it.
  EXPECT_TRUE(endedWith(ExitCode::unwritable_output, runProgram(run.live()), {"holds the map of an earlier run"}));
  EXPECT_TRUE(endedWith(ExitCode::ok, map({kBox}, run.folder / "more", {"--continue", run.out()})));
}

// A row for a table of commands, given now.
std::string commandNow(omnimapper::obs::CommandKind kind, const std::string& text) {
  omnimapper::obs::CObservationCommand command;
  command.timestamp = omnimapper::live::hostNow();
  command.kind = kind;
  command.subject = omnimapper::obs::CommandSubject::place;
  command.text = text;
  return omnimapper::obs::commandRow(command) + "\n";
}

std::string labelsOf(const std::string& map) {
  const auto file = omnimapper::map::MapFile::read(map);
  const auto* section = file.find(omnimapper::map::Labels::kLayer);
  std::string all;
  if (section)
    for (const auto& label : omnimapper::map::Labels::fromSection(*section).labels) all += label.text + ";";
  return all;
}

// The user adds walls to the INI while the robot drives, and then a plugin that does not exist. In between, somebody
// names where the robot is, in a table of commands.
TEST(LiveRun, pluginsComeWhileTheRunGoesOnAndAReplayBringsThemAgain) {
  LiveRun run(4);
  run.play(kBox);
  const std::string ini = run.folder / "live.ini", commands = run.folder / "commands.csv";
  std::string settings = readFile(ini) + "[page]\ndriver = CCommandFile\nfile = " + commands + "\n";
  settings.replace(settings.find("wheels"), 6, "wheels, page");
  writeFile(ini, settings);
  Program mapper(run.live());
  const auto journal = [&] { return readFile(run.recorded(".journal")); };
  const auto waitFor = [&](const std::function<bool()>& state) {
    while (mapper.isRunning() && !state()) sleep(0.02);
  };
  waitFor([&] { return !run.recorded(".journal").empty() && journal().find("a 100\n") != std::string::npos; });
  writeFile(ini, settings +
                     "[mapper]\nmeasurement_plugins = walls, loop_closure, labels\n[labels]\nclass = LabelsPlugin\n"
                     "[perception]\nextractors = laser_points, laser_lines\n"
                     "[laser_lines]\nclass = LaserLineExtractor\n"
                     "[walls]\nclass = PlaneLandmarksPlugin\nform = wall\n");
  mapper.send(SIGUSR1);
  waitFor([&] { return journal().find("p 1\n") != std::string::npos; });
  using omnimapper::obs::CommandKind;
  std::string rows = std::string(omnimapper::obs::kCommandColumns) + "\n";
  rows += commandNow(CommandKind::go_to, "kitchen");
  rows += commandNow(CommandKind::label, "corner");
  writeFile(commands, rows);
  writeFile(ini, settings + "[mapper]\nmeasurement_plugins = ceilings\n[ceilings]\nclass = CeilingPlugin\n");
  mapper.send(SIGUSR1);
  waitFor([&] { return mapper.saidSoFar().find("stay as they were") != std::string::npos; });
  run.player->wait();
  mapper.send(SIGINT);
  const auto ended = mapper.wait();
  ASSERT_TRUE(endedWith(ExitCode::ok, ended, {"the plugins stay as they were", "CeilingPlugin"}));
  EXPECT_GE(run.summary().at("landmarks").value("wall", 0), 3) << run.summary().at("landmarks");
  EXPECT_EQ(journal().find("p 2\n"), std::string::npos);
  EXPECT_EQ(labelsOf(run.out() + "/map.omnimap"), "corner;") << toString(ended);
  EXPECT_EQ(ended.err.find("[page]"), std::string::npos) << "commands are seldom: " << ended.err;
  const auto again = run.folder / "again";
  ASSERT_TRUE(endedWith(ExitCode::ok, graphslam({"--replay", run.out(), "-o", again})));
  EXPECT_EQ(readFile(again + "/map.omnimap"), readFile(run.out() + "/map.omnimap"));
}

void expectNear(const LiveRun& run) {
  EXPECT_LT(errorOf(run.out() + "/trajectory.tum", run.folder / "truth.tum"), 0.05);
}

// Two robots at once. The laser of the first is gone for one second, which is eight seconds of the log; before that, it
// answers slowly, and some data of laser and wheels are damaged. Laser and wheels of the second are gone at the same
// time.
TEST(LiveRun, goesOnWithoutSensorsUntilTheyAreBack) {
  LiveRun damaged(8, {"garbage@20", "half@30", "checksum@40", "slow@50:0.15", "hangup@120:1"},
                  {"garbage@30", "half@70"});
  LiveRun lost(8, {"hangup@120:1.2"}, {"hangup@240:1"});
  damaged.play(kBox, kTruth);
  Program mapper(damaged.live({"--set", "live.silent_after_s=3"}));  // longer than a busy machine may pause
  const auto ended_of_lost = playAndMap(lost);
  damaged.player->wait();
  sleep(0.5);
  mapper.send(SIGINT);
  ASSERT_TRUE(endedWith(ExitCode::ok, mapper.wait(), {"[laser] is lost", "[laser] is back"}));
  for (const auto& sensor : damaged.summary().at("live").at("sensors")) {
    const bool is_laser = sensor.at("name") == "laser";
    EXPECT_EQ(sensor.at("reopened"), is_laser ? 1 : 0);
    EXPECT_GE(sensor.at("left_out"), 2);
    if (!is_laser) {
      EXPECT_GE(sensor.at("observations"), kOdometry - 4) << "a damaged line may cost the next one";
    }
  }
  expectNear(damaged);

  ASSERT_TRUE(endedWith(ExitCode::ok, ended_of_lost, {"[laser] is lost", "[laser] is back", "[wheels] is back"}));
  const auto summary = lost.summary().at("live");
  for (const auto& sensor : summary.at("sensors")) EXPECT_GE(sensor.at("reopened"), 1) << sensor;
  EXPECT_EQ(summary.at("arrived"), summary.at("given"));
  expectNear(lost);
}

// Localizes a robot that is switched on at the place where the log of the map began.
TEST(LiveRun, isLocatedInAMap) {
  LiveRun run(12);
  const auto known = run.folder / "known";
  ASSERT_TRUE(endedWith(ExitCode::ok, map({kBox}, known)));
  const auto ended = playAndMap(run, {"--localize", known + "/map.omnimap", "--set", "session.start=origin"});
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  EXPECT_NE(ended.out.find("located           9"), std::string::npos) << "90 % or more: " << ended.out;
  EXPECT_EQ(run.summary().at("live").at("given"), kScans + kOdometry);
  expectNear(run);
}

TEST(LiveRun, onAFullDiskTheMapIsMadeAllTheSame) {
  LiveRun run(12);
  const auto ended = playAndMap(run,
                                {"--set", "live.compression=0", "--set", "live.checkpoint_s=0", "--set",
                                 "mapper.output_plugins=trajectory,summary"},
                                {120, 150000});
  ASSERT_TRUE(endedWith(ExitCode::disk_full, ended, {"recording ended"}));
  EXPECT_TRUE(fs::exists(run.out() + "/trajectory.tum"));
  // The recording up to then can be read.
  EXPECT_TRUE(endedWith(ExitCode::ok, map({run.recorded(".rawlog")}, run.folder / "recorded")));
}

// Two robots at once: one is checked, the other recorded meanwhile.
TEST(LiveRun, checksOrRecordsWithoutMapping) {
  LiveRun checked(4), run(10);
  checked.play(kBox);
  Program check(checked.command({"--check", "--live", "--set", "live.check_s=3", "--set", "laser.poze_z=0.3"}));
  run.play(kBox);
  Program recorder(run.command({"--record-only", "-o", run.out()}));
  run.player->wait();
  sleep(0.3);
  recorder.send(SIGTERM);
  const auto recorded = recorder.wait();
  ASSERT_TRUE(endedWith(ExitCode::ok, recorded));
  EXPECT_NE(recorded.out.find("MB/s"), std::string::npos) << recorded.out;
  const auto rawlogs = filesIn(run.out(), ".rawlog");
  ASSERT_EQ(rawlogs.size(), 1u);
  EXPECT_TRUE(endedWith(ExitCode::ok, map({rawlogs.front()}, run.folder / "map")));
  const auto ended = check.wait();
  EXPECT_TRUE(endedWith(ExitCode::ok, ended));
  EXPECT_NE(ended.out.find("Nothing is wrong with the observations"), std::string::npos) << ended.out;
  EXPECT_NE(ended.err.find("a key that its driver CHokuyoURG does not read: poze_z (did you mean pose_z?)"),
            std::string::npos)
      << ended.err;
}

TEST(LiveRun, aMapThatIsThereIsNotReplaced) {
  LiveRun run(1);
  ASSERT_TRUE(endedWith(ExitCode::ok, map({kBox}, run.out())));
  const auto before = readFile(run.out() + "/map.omnimap");
  EXPECT_TRUE(endedWith(ExitCode::unwritable_output, runProgram(run.live()), {"holds the map of an earlier run"}));
  EXPECT_EQ(readFile(run.out() + "/map.omnimap"), before);
}

TEST(LiveRun, aSensorThatIsNotThereIsNamedAndNothingIsWritten) {
  LiveRun run(1);
  const auto ended = runProgram(run.live({"--set", "laser.PORT_DIIR=10940"}));
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, ended,
                        {"sensor [laser]", "cannot be opened", "does not read: PORT_DIIR (did you mean PORT_DIR?)"}));
  EXPECT_FALSE(fs::exists(run.out()));
  EXPECT_TRUE(
      endedWith(ExitCode::wrong_type, runProgram(run.live({"--set", "laser.pose_yaw=9o"})), {"9o is no number"}));
  EXPECT_TRUE(endedWith(ExitCode::command_line,
                        graphslam({"-i", sourceFile("ini/laser2d.ini"), "--live", "-o", run.out()}),
                        {"[live] sensors"}));
  EXPECT_TRUE(endedWith(ExitCode::command_line,
                        graphslam({"-i", sourceFile("ini/laser2d.ini"), "--live", "-r", kBox, "-o", run.out()})));
}

}  // namespace
