// Logs that are localized in a map on the command line with --localize: what is written, what is refused, and that the
// map stays as it is.
#include <omnimapper/eval/RelationError.h>

#include <sstream>

#include "../CutLog.h"
#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::sharedData;
using omnimapper::testing::SimulatedLogOptions;

// Two laps of the simulated ring; the map is of the first.
class Localize : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = std::make_unique<ScratchFolder>();
    SimulatedLogOptions options;
    options.laps = 2;
    log_ = std::make_unique<SimulatedLog>(options);
    log_->writeRawlog(file("ring.rawlog"));
    const double seconds = omnimapper::base::secondsBetween(log_->begin(), log_->end());
    cutLog(file("ring.rawlog"), log_->begin() + omnimapper::base::durationFromSeconds(seconds / 2), file("a.rawlog"),
           file("b.rawlog"));
    ASSERT_TRUE(endedWith(ExitCode::ok, map({file("a.rawlog")}, file("first"))));
    map_bytes_ = readFile(file("first/map.omnimap"));
  }
  static void TearDownTestSuite() {
    scratch_.reset();
    log_.reset();
  }
  static std::string file(const std::string& name) { return *scratch_ / name; }
  static Ended localize(const std::string& to, Words more = {}) {
    more.insert(more.end(), {"--localize", file("first")});
    return map({file("b.rawlog")}, file(to), more);
  }

  static inline std::unique_ptr<ScratchFolder> scratch_;
  static inline std::unique_ptr<SimulatedLog> log_;
  static inline std::string map_bytes_;
};

TEST_F(Localize, GivesTheTrajectoryInTheMapsFrameWithItsAccuracyAndLeavesTheMapAlone) {
  const auto ended = localize("located");
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  EXPECT_NE(ended.out.find("located "), std::string::npos) << ended.out;
  EXPECT_EQ(filesIn(file("located")),
            (std::set<std::string>{"localization.csv", "map.png", "report.html", "summary.json", "trajectory.tum"}));
  EXPECT_TRUE(readFile(file("first/map.omnimap")) == map_bytes_);
  const auto trajectory = loadTrajectory(file("located"));
  omnimapper::eval::Trajectory truth;
  for (const auto& pose : trajectory) {
    EXPECT_GT(pose.stamp, log_->begin() + omnimapper::base::durationFromSeconds(10)) << "of this log alone";
    const mrpt::poses::CPose3D map_from_base(log_->truthAt(pose.stamp) - log_->truthAt(log_->begin()));
    const Eigen::Vector3d away =
        omnimapper::geometry::fromMrpt(map_from_base).translation - pose.world_from_body.translation;
    EXPECT_LT(away.norm(), 0.25);
  }
  const auto summary = loadSummary(file("located"));
  EXPECT_GT(summary["localization"]["located"].get<double>(),
            0.9 * summary["localization"]["key_frames"].get<double>());
  std::istringstream lines(readFile(file("located/localization.csv")));
  std::string line;
  std::size_t count = 0;
  for (std::getline(lines, line); std::getline(lines, line); ++count) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 10) << line;
  }
  EXPECT_EQ(count, summary["localization"]["key_frames"].get<std::size_t>());
}

TEST_F(Localize, ALogOfAnotherBuildingIsLocatedNowhereWithAnExitCodeOfItsOwn) {
  SimulatedLogOptions options;
  options.place = SimulatedLogOptions::Place::box;
  SimulatedLog(options).writeRawlog(file("box.rawlog"));
  const auto ended = map({file("box.rawlog")}, file("nowhere"), {"--localize", file("first")});
  EXPECT_TRUE(endedWith(ExitCode::not_located, ended, {"located nowhere", "[session] start"}));
  EXPECT_TRUE(fs::exists(file("nowhere/report.html"))) << "to see why";
}

TEST_F(Localize, WhatWouldHarmTheMapIsRefused) {
  EXPECT_TRUE(endedWith(ExitCode::command_line, localize("first"), {"folder of the map itself"}));
  EXPECT_TRUE(endedWith(ExitCode::command_line, localize("none", {"--continue", file("first")}), {"give one of them"}));
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input,
                        map({file("b.rawlog")}, file("none"), {"--localize", file("absent.omnimap")}),
                        {"absent.omnimap"}));
  EXPECT_TRUE(readFile(file("first/map.omnimap")) == map_bytes_);
  EXPECT_FALSE(fs::exists(file("none")));
}

}  // namespace
