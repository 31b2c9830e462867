// The same input gives the same map, bit for bit: twice, with any number of threads, from one file or several.
#include <omnimapper/source/RawlogWriter.h>

#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::SimulatedLogOptions;

class Repeat : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = std::make_unique<ScratchFolder>();
    SimulatedLogOptions options;
    options.laps = 1.2;
    log_ = std::make_unique<SimulatedLog>(options);
    log_->writeRawlog(file("ring.rawlog"));
    ASSERT_TRUE(endedWith(ExitCode::ok, map({file("ring.rawlog")}, file("first"), {"--threads", "1"})));
    ASSERT_GT(loopClosures(loadMap(file("first"))).size(), 0U);
  }
  static void TearDownTestSuite() {
    scratch_.reset();
    log_.reset();
  }

  static std::string file(const std::string& name) { return *scratch_ / name; }
  static void expectSameAsFirst(const std::string& folder) {
    for (const char* name : {"trajectory.tum", "graph.g2o", "grid.pgm", "points.ply"}) {
      EXPECT_TRUE(readFile(file("first/") + name) == readFile(folder + "/" + name)) << name << " differs";
    }
    EXPECT_TRUE(mapBytes(file("first")) == mapBytes(folder)) << "map.omnimap differs";
  }
  // The bytes of a map without the names of the logs, which it keeps as the titles of its sessions.
  static std::string mapBytes(const std::string& folder) {
    auto saved = loadMap(folder);
    for (auto& session : saved.map.sessions) session.title = "log";
    omnimapper::derived::mapFileOf(saved.map, saved.graph).write(file("untitled.omnimap"));
    return readFile(file("untitled.omnimap"));
  }
  /// A rawlog of the observations of one sensor.
  static std::string part(const std::string& label) {
    const std::string path = file(label + ".rawlog");
    omnimapper::source::writeRawlog(path, [&](omnimapper::source::RawlogWriter& writer) {
      for (const auto& observation : log_->observations()) {
        if (observation->sensorLabel == label) writer.add(*observation);
      }
    });
    return path;
  }

  static inline std::unique_ptr<ScratchFolder> scratch_;
  static inline std::unique_ptr<SimulatedLog> log_;
};

TEST_F(Repeat, ASecondRunWritesTheSameBytes) {
  ASSERT_TRUE(endedWith(ExitCode::ok, map({file("ring.rawlog")}, file("second"))));
  expectSameAsFirst(file("second"));
}

TEST_F(Repeat, WorkerThreadsChangeNoByte) {
  for (const char* threads : {"2", "5"}) {
    ASSERT_TRUE(endedWith(ExitCode::ok, map({file("ring.rawlog")}, file("threads"), {"--threads", threads})));
    expectSameAsFirst(file("threads"));
  }
}

TEST_F(Repeat, TwoFilesMergedGiveTheMapOfOne) {
  const std::string laser = part("laser"), odometry = part("odometry");
  ASSERT_TRUE(endedWith(ExitCode::ok, map({laser, odometry}, file("merged"))));
  expectSameAsFirst(file("merged"));
  ASSERT_TRUE(endedWith(ExitCode::ok, map({odometry, laser}, file("merged"), {"--threads", "2"})));
  expectSameAsFirst(file("merged"));
}

TEST_F(Repeat, ReplayAtAPaceTakesItsTimeAndChangesNoByte) {
  const double log_seconds = omnimapper::base::secondsBetween(log_->begin(), log_->end());
  const double speed = log_seconds / 2;
  const auto ended = map({file("ring.rawlog")}, file("paced"), {"--speed", std::to_string(speed)});
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  EXPECT_GT(ended.seconds, 1.95);
  expectSameAsFirst(file("paced"));
}

}  // namespace
