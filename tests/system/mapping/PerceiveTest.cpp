// omnimapper-perceive writes a log of derived observations, which gives the same map as the raw log.
#include <omnimapper/source/RawlogSource.h>

#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::SimulatedLogOptions;

class Perceive : public ::testing::Test {
 protected:
  Perceive() {
    SimulatedLogOptions options;
    options.place = SimulatedLogOptions::Place::box;
    SimulatedLog(options).writeRawlog(raw_);
  }
  Ended perceive(const std::string& log, const std::string& output, const Texts& more = {}) {
    Texts words{omnimapper::testing::ownProgram("omnimapper-perceive"),
                "-i",
                omnimapper::testing::sourceFile("ini/laser2d.ini"),
                "-r",
                log,
                "-o",
                output};
    words.insert(words.end(), more.begin(), more.end());
    return omnimapper::testing::runProgram(words);
  }
  std::map<std::string, std::size_t> labelsOf(const std::string& log) {
    std::map<std::string, std::size_t> labels;
    omnimapper::source::RawlogSource source(log);
    while (const auto observation = source.next()) ++labels[observation->sensorLabel];
    EXPECT_EQ(source.report().exitCode(), ExitCode::ok);
    return labels;
  }

  omnimapper::testing::ScratchFolder scratch_;
  const std::string raw_ = scratch_ / "box.rawlog", derived_ = scratch_ / "derived.rawlog";
};

TEST_F(Perceive, LeavesWhatTheExtractorsMakeTheSameBytesOnAnyNumberOfThreads) {
  const auto ended = perceive(raw_, derived_, {"--threads", "1"});
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  EXPECT_NE(ended.out.find("laser_points: "), std::string::npos) << ended.out;
  const auto raw = labelsOf(raw_), derived = labelsOf(derived_);
  EXPECT_EQ(derived, (std::map<std::string, std::size_t>{{"laser.points", raw.at("laser")}}));
  ASSERT_TRUE(endedWith(ExitCode::ok, perceive(raw_, scratch_ / "again.rawlog", {"--threads", "3"})));
  EXPECT_TRUE(readFile(scratch_ / "again.rawlog") == readFile(derived_));
}

TEST_F(Perceive, RawAndDerivedTogetherMapAsTheRawLogDoes) {
  ASSERT_TRUE(endedWith(ExitCode::ok, perceive(raw_, derived_)));
  ASSERT_TRUE(endedWith(ExitCode::ok, perceive(raw_, scratch_ / "both.rawlog", {"--with-raw"})));
  auto all = labelsOf(raw_);
  all.merge(labelsOf(derived_));
  EXPECT_EQ(labelsOf(scratch_ / "both.rawlog"), all);
  ASSERT_TRUE(endedWith(ExitCode::ok, map({raw_}, scratch_ / "raw")));
  ASSERT_TRUE(endedWith(ExitCode::ok, map({raw_, derived_}, scratch_ / "merged")));
  ASSERT_TRUE(endedWith(ExitCode::ok, map({scratch_ / "both.rawlog"}, scratch_ / "both")));
  for (const char* file : {"trajectory.tum", "graph.g2o"}) {
    EXPECT_TRUE(readFile(scratch_ / "merged" + "/" + file) == readFile(scratch_ / "raw" + "/" + file)) << file;
    EXPECT_TRUE(readFile(scratch_ / "both" + "/" + file) == readFile(scratch_ / "raw" + "/" + file)) << file;
  }
}

TEST_F(Perceive, WithoutTheRawScansItMapsAsTheRawLogDoes) {
  ASSERT_TRUE(endedWith(ExitCode::ok, perceive(raw_, scratch_ / "both.rawlog", {"--with-raw"})));
  // Laser odometry needs raw scans, so both runs take the motion from the wheels.
  const Texts wheels{"--set", "mapper.pose_plugins=odometry, no_motion", "--set",
                     "mapper.output_plugins=trajectory, graph"};
  Texts derived = wheels;
  derived.insert(derived.end(), {"--set", "source.labels=odometry, laser.points"});
  ASSERT_TRUE(endedWith(ExitCode::ok, map({raw_}, scratch_ / "raw", wheels)));
  ASSERT_TRUE(endedWith(ExitCode::ok, map({scratch_ / "both.rawlog"}, scratch_ / "derived", derived)));
  for (const char* file : {"trajectory.tum", "graph.g2o"}) {
    const std::string of_raw = readFile(scratch_ / "raw" + "/" + file);
    EXPECT_GT(of_raw.size(), 1000U) << file;
    EXPECT_TRUE(readFile(scratch_ / "derived" + "/" + file) == of_raw) << file;
  }
}

TEST_F(Perceive, MistakesAreReported) {
  EXPECT_TRUE(endedWith(ExitCode::out_of_range, perceive(raw_, derived_, {"--set", "perception.extractors="}),
                        {"--set perception.extractors: [perception] extractors"}));
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, perceive(scratch_ / "none.rawlog", derived_), {"none.rawlog"}));
  EXPECT_TRUE(endedWith(ExitCode::nothing_to_map, perceive(raw_, derived_, {"--set", "source.labels=odometry"}),
                        {"no observation from which an extractor"}));
  EXPECT_FALSE(fs::exists(derived_));
  const std::string whole = readFile(raw_);
  writeFile(scratch_ / "cut.rawlog", whole.substr(0, whole.size() / 2));
  EXPECT_TRUE(endedWith(ExitCode::damaged_input, perceive(scratch_ / "cut.rawlog", derived_), {"cut.rawlog"}));
  EXPECT_GT(labelsOf(derived_).at("laser.points"), 10U) << "the readable part";
}

}  // namespace
