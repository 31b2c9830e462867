// A map and a rawlog that an earlier version wrote (tests/system/mapping/earlier) can still be loaded, continued,
// localized in and mapped.
#include <set>

#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::sourceFile;

constexpr std::size_t kKeyFrames = 17, kLandmarks = 25;  // one of the landmarks was merged into another

class EarlierVersions : public ::testing::Test {
 protected:
  static std::string earlier(const std::string& file) { return sourceFile("tests/system/mapping/earlier/" + file); }
  /// Maps a part of the log from which they were made, without its depth images.
  Ended mapHome(const std::string& labels, const Texts& more) {
    Texts words{
        "-i",    sourceFile("ini/home_planes.ini"), "-r", sourceFile("rawlogs/home_30s/home_30s.rawlog"), "-o", out_,
        "--set", "source.labels=" + labels};
    words.insert(words.end(), more.begin(), more.end());
    return graphslam(words);
  }

  ScratchFolder scratch_;
  std::string out_ = scratch_ / "out";
};

TEST_F(EarlierVersions, AMapLoads) {
  const auto loaded = loadMap(earlier(""));
  EXPECT_EQ(loaded.map.key_frames.size(), kKeyFrames);
  EXPECT_EQ(loaded.map.landmarks.size(), kLandmarks);
  std::set<std::string> classes;
  for (const auto& frame : loaded.map.key_frames) {
    for (const auto& observation : frame.observations) classes.insert(observation->GetRuntimeClass()->className);
  }
  EXPECT_EQ(classes,
            (std::set<std::string>{"mrpt::obs::CObservation2DRangeScan", "mrpt::obs::CObservationPointCloud",
                                   "omnimapper::obs::CObservationLaserLines", "omnimapper::obs::CObservationPlanes"}));
}

TEST_F(EarlierVersions, AMapIsContinuedAndItsLandmarksAreMeasuredAgain) {
  const auto ended = mapHome("laser,odometry", {"--set", "source.start_s=8", "--continue", earlier("map.omnimap")});
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  const auto both = loadMap(out_);
  ASSERT_EQ(both.map.sessions.size(), 2U);
  EXPECT_TRUE(both.map.sessions[1].aligned);
  EXPECT_GT(both.map.key_frames.size(), kKeyFrames + 10);
  std::set<omnimapper::base::LandmarkId> measured_again;
  for (const auto& [id, record] : both.graph.factors()) {
    const auto& landmark = record.tags.landmark;
    if (id.session == 1 && landmark && landmark->session == 0) measured_again.insert(*landmark);
  }
  EXPECT_GT(measured_again.size(), 5U) << "of " << kLandmarks;
}

TEST_F(EarlierVersions, ALogIsLocalizedInAMap) {
  const auto ended = mapHome("laser,odometry", {"--set", "source.start_s=8", "--localize", earlier("map.omnimap")});
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  const auto summary = loadSummary(out_)["localization"];
  EXPECT_GT(summary["key_frames"], 10);
  EXPECT_EQ(summary["located"], summary["key_frames"]);
}

TEST_F(EarlierVersions, APerceivedRawlogIsMapped) {
  const auto ended = mapHome("laser,odometry,laser.points,laser.lines,kinect.planes",
                             {"-r", earlier("perceived.rawlog"), "--set", "source.end_s=8"});
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  const auto loaded = loadMap(out_);
  EXPECT_EQ(loaded.map.key_frames.size(), kKeyFrames);
  bool has_planes = false;
  for (const auto& [id, record] : loaded.graph.factors())
    has_planes = has_planes || record.factor->kind() == "plane_from_se3";
  EXPECT_TRUE(has_planes) << "only the perceived log has planes";
}

}  // namespace
