// Runs ini/moveables.ini as its first lines say, on markers of the simulated offices, ten of which are carried away.
#include "../MapFolder.h"
#include "../simulate/SimulateRun.h"

namespace {

using namespace runs;
using nlohmann::json;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::sourceFile;

class Moveables : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = std::make_unique<ScratchFolder>();
    ASSERT_TRUE(
        endedWith(ExitCode::ok, simulate({"-i", sourceFile("rawlogs/two_offices.ini"), "--set",
                                          "simulation.sensors=markers,odometry", "-o", *scratch_ / "offices"})));
  }
  static void TearDownTestSuite() { scratch_.reset(); }
  static Ended mapIt(const std::string& folder, const Texts& more = {}) {
    Texts words{"-i", sourceFile("ini/moveables.ini"), "-r", *scratch_ / "offices/two_offices.rawlog", "-o", folder};
    words.insert(words.end(), more.begin(), more.end());
    return graphslam(words);
  }

  static std::unique_ptr<ScratchFolder> scratch_;
};
std::unique_ptr<ScratchFolder> Moveables::scratch_;

TEST_F(Moveables, WhatWasCarriedAwayIsFoundAndNothingElse) {
  constexpr int kFirstCarried = 29;  // markers with smaller numbers are pinned to the walls
  const std::string folder = *scratch_ / "map";
  ASSERT_TRUE(endedWith(ExitCode::ok, mapIt(folder)));
  const auto loaded = loadMap(folder);
  std::size_t records = 0, standing = 0;
  for (const auto& [id, landmark] : loaded.map.landmarks) {
    records += landmark.kind == "moved thing";
    standing += landmark.state == map_file::Landmark::State::active;
  }
  EXPECT_GE(records, 2U);
  EXPECT_GE(standing, 25U);
  std::size_t relocations = 0;
  const auto plan = json::parse(readFile(folder + "/floorplan.geojson"));
  for (const auto& feature : plan["features"]) {
    const auto& properties = feature["properties"];
    if (properties.value("state", "") != "moved") continue;
    const std::string label = properties["label"];
    ASSERT_EQ(label.rfind("marker ", 0), 0U) << label;
    EXPECT_GE(std::stoi(label.substr(7)), kFirstCarried);
    relocations += feature["geometry"]["type"] == "LineString";
  }
  EXPECT_EQ(relocations, records);
  omnimapper::eval::PairingOptions pairing;
  pairing.alignment = omnimapper::eval::Alignment::se3;
  const auto error = omnimapper::eval::absoluteTrajectoryError(
      loadTrajectory(folder), omnimapper::eval::readTum(*scratch_ / "offices/truth.tum"), pairing);
  EXPECT_LT(error.translation.rmse, 0.15);
  EXPECT_NE(readFile(folder + "/report.html").find("moved: it was seen in more than one place"), std::string::npos);
}

TEST_F(Moveables, ASectionThatIsNoneIsRefused) {
  EXPECT_TRUE(endedWith(ExitCode::unknown_key, mapIt(*scratch_ / "none", {"--set", "moveables.landmarks=pionts"}),
                        {"[moveables] landmarks: 'pionts'", "did you mean 'points'?"}));
}

}  // namespace
