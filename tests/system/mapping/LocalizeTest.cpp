// Logs that are localized in a map with --localize: which outputs are written, what is refused, and that the map stays
// as it is.
#include <sstream>

#include "../CutLog.h"
#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::SimulatedLogOptions;

class Localize : public CutRing {
 protected:
  static void SetUpTestSuite() {
    CutRing::SetUpTestSuite();
    map_bytes_ = readFile(file("first/map.omnimap"));
  }
  static Ended localize(const std::string& to, Texts more = {}) {
    more.insert(more.end(), {"--localize", file("first")});
    return map({file("b.rawlog")}, file(to), more);
  }

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
    EXPECT_GT(pose.stamp, log_->begin() + omnimapper::base::durationFromSeconds(10))
        << "only poses of this log are expected";
    const mrpt::poses::CPose3D map_from_base(log_->truthAt(pose.stamp) - log_->truthAt(log_->begin()));
    const Eigen::Vector3d away =
        omnimapper::geometry::fromMrpt(map_from_base).translation - pose.world_from_body.translation;
    EXPECT_LT(away.norm(), 0.25);
  }
  const auto summary = loadSummary(file("located"));
  EXPECT_GT(summary["localization"]["located"].get<double>(),
            0.9 * summary["localization"]["key_frames"].get<double>());
  EXPECT_NE(readFile(file("located/report.html")).find("new key frames located"), std::string::npos);
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
  EXPECT_NE(readFile(file("nowhere/report.html")).find("was located nowhere in the map"), std::string::npos);
}

TEST_F(Localize, WhatWouldHarmTheMapIsRefused) {
  EXPECT_TRUE(endedWith(ExitCode::command_line, localize("first"), {"folder of a map"}));
  EXPECT_TRUE(endedWith(ExitCode::command_line, localize("none", {"--continue", file("first")}), {"give one of them"}));
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input,
                        map({file("b.rawlog")}, file("none"), {"--localize", file("absent.omnimap")}),
                        {"absent.omnimap"}));
  EXPECT_TRUE(readFile(file("first/map.omnimap")) == map_bytes_);
  EXPECT_FALSE(fs::exists(file("none")));
}

}  // namespace
