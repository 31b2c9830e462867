// omnimapper-simulate: the files that it writes.
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "SimulateRun.h"

namespace {

using namespace runs;
using nlohmann::json;
using omnimapper::obs::CObservationRelativeMotion;
using omnimapper::source::SourceReport;

class Simulate : public ::testing::Test {
 protected:
  Simulate() { writeFile(ini_, kSmallWorld); }
  Ended run(const std::string& folder, const Texts& more = {}) {
    Texts words{"-i", ini_, "-o", scratch_ / folder};
    words.insert(words.end(), more.begin(), more.end());
    return simulate(words);
  }
  std::uint64_t countOf(const std::string& folder, const std::string& label) {
    std::uint64_t count = 0;
    const auto report = readLog(scratch_ / folder + "/small.rawlog");
    EXPECT_EQ(report.ending, SourceReport::Ending::complete) << report.message;
    for (const auto& [sensor, counts] : report.sensors) count += sensor.first == label ? counts.observations : 0;
    return count;
  }

  omnimapper::testing::ScratchFolder scratch_;
  const std::string ini_ = scratch_ / "small.ini";
};

TEST_F(Simulate, TheSameIniGivesTheSameBytesOnAnyNumberOfThreadsAndAnotherSeedOthers) {
  ASSERT_TRUE(endedWith(ExitCode::ok, run("one", {"--threads", "1"})));
  ASSERT_TRUE(endedWith(ExitCode::ok, run("three", {"--threads", "3"})));
  const auto one = contentOf(scratch_ / "one"), three = contentOf(scratch_ / "three");
  ASSERT_GT(one.size(), 15U);
  for (const auto& [name, bytes] : one) {
    ASSERT_TRUE(three.count(name)) << name;
    EXPECT_TRUE(three.at(name) == bytes) << name;
  }
  EXPECT_EQ(one.size(), three.size());
  ASSERT_TRUE(endedWith(ExitCode::ok, run("other", {"--set", "simulation.seed=2"})));
  EXPECT_TRUE(readFile(scratch_ / "other/truth.tum") == one.at("truth.tum"))
      << "the seed changes the measurements only";
  EXPECT_FALSE(readFile(scratch_ / "other/small.rawlog") == one.at("small.rawlog"));
}

TEST_F(Simulate, EveryMeasurementIsInTheLogInTheOrderOfArrivalWithItsTruth) {
  const auto ended = run("out", {"--set", "camera.latency_s=0.2"});
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  EXPECT_NE(ended.out.find("camera: 13 measurements"), std::string::npos) << ended.out;
  std::vector<omnimapper::base::Stamp> arrivals;
  std::set<omnimapper::base::Stamp> stamps;
  readLog(scratch_ / "out/small.rawlog", [&](const mrpt::obs::CObservation& observation) {
    stamps.insert(observation.timestamp);
    const bool late = observation.sensorLabel == "camera";
    arrivals.push_back(observation.timestamp + omnimapper::base::durationFromSeconds(late ? 0.2 : 0.0));
  });
  EXPECT_TRUE(std::is_sorted(arrivals.begin(), arrivals.end()));
  EXPECT_EQ(arrivals.size(), 31U + 13U + 121U);
  const auto truth = omnimapper::eval::readTum(scratch_ / "out/truth.tum");
  ASSERT_EQ(truth.size(), stamps.size());
  for (const auto& pose : truth) EXPECT_TRUE(stamps.count(pose.stamp));
  EXPECT_LT((truth.front().world_from_body.translation - Eigen::Vector3d(1, 1, 0)).norm(), 1e-9);
}

TEST_F(Simulate, TruthNamesWhatBeamsAndPixelsSaw) {
  ASSERT_TRUE(endedWith(ExitCode::ok, run("out")));
  const json landmarks = json::parse(readFile(scratch_ / "out/landmarks.json"));
  std::map<int, std::string> kinds;
  for (const auto& surface : landmarks["surfaces"]) kinds[surface["label"]] = surface["kind"];
  EXPECT_EQ(landmarks["rooms"].size(), 2U);
  EXPECT_EQ(landmarks["rooms"][0]["number"], "118");
  std::istringstream lines(readFile(scratch_ / "out/truth/laser.jsonl"));
  int wall_beams = 0, beams = 0, count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const json entry = json::parse(line);
    EXPECT_EQ(entry["measurement"], count);
    for (const auto& [label, run_length] : entry["truth"]["surfaces"].get<std::vector<std::pair<int, int>>>()) {
      beams += run_length;
      if (label == 0) continue;
      ASSERT_TRUE(kinds.count(label)) << label;
      if (kinds[label] == "wall") wall_beams += run_length;
    }
  }
  EXPECT_EQ(count, 31);
  EXPECT_GT(wall_beams, 0.5 * beams);
  EXPECT_EQ(filesIn(scratch_ / "out/truth/labels").size(), 13U);
  const std::string readme = readFile(scratch_ / "out/README.md");
  for (const char* name : {"small.rawlog", "truth.tum", "landmarks.json", "surfaces.json", "world.ply", "plan.svg",
                           "truth/laser.jsonl", "small.ini"}) {
    EXPECT_NE(readme.find(std::string("`") + name + "`"), std::string::npos) << name;
    EXPECT_TRUE(fs::exists(scratch_ / "out/" + name)) << name;
  }
}

// The sign hangs 1.2 m to the left of a camera that looks there: capitals of 4.2 cm are about
// 600 * 0.042 / 1.2 pixels high.
TEST_F(Simulate, TheSignsThatPicturesShowAreATableBesideTheLog) {
  const std::string more = scratch_ / "more.ini";
  writeFile(more,
            "[world]\nsigns = sign_1\n[sign_1]\nclass = dark\ntext = 7, \"E\" | Ann\nx_m = 1\ny_m = 3.9\n[robot]\n"
            "start = 1 2.8\nwaypoints = 1 2.8\nmode = still\n[eye]\nclass = ColourCamera\nyaw_deg = 90\nz_m = 1.4\n"
            "rate_hz = 1\n");
  const auto ended = run("out", {"-i", more, "--set", "simulation.sensors=eye, odometry"});
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  EXPECT_NE(ended.out.find("signs: 1, legible in three pictures or more 1, on two visits or more 0"), std::string::npos)
      << ended.out;
  std::istringstream table(readFile(scratch_ / "out/signs_seen.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(table, line));
  EXPECT_EQ(line.rfind("stamp,sensor,measurement,sign,text,x1,y1,", 0), 0U) << line;
  int rows = 0;
  for (; std::getline(table, line); ++rows) {
    EXPECT_NE(line.find(",eye," + std::to_string(rows) + ",sign_1,\"7, \"\"E\"\"|Ann\","), std::string::npos) << line;
    EXPECT_EQ(line.substr(line.size() - 7), ",1.00,1") << line;
  }
  EXPECT_EQ(rows, 7);
  EXPECT_NE(readFile(scratch_ / "out/README.md").find("`signs_seen.csv`"), std::string::npos);
  const json sign = json::parse(readFile(scratch_ / "out/landmarks.json"))["signs"][0];
  EXPECT_EQ(sign["capitals"], (std::vector<double>{0.042, 0.017}));
}

// One log of the camera can serve all seeds of the other sensors: neither it nor the truth depends on other sensors.
TEST_F(Simulate, SensorsOfOneDriveMayBeSimulatedSeparatelyWithDifferentSeeds) {
  ASSERT_TRUE(endedWith(ExitCode::ok, run("whole")));
  ASSERT_TRUE(endedWith(ExitCode::ok, run("camera", {"--set", "simulation.sensors=camera"})));
  ASSERT_TRUE(endedWith(ExitCode::ok,
                        run("others", {"--set", "simulation.sensors=laser, odometry", "--set", "simulation.seed=7"})));
  EXPECT_TRUE(readFile(scratch_ / "camera/truth/camera.jsonl") == readFile(scratch_ / "whole/truth/camera.jsonl"));
  const auto depthsOf = [&](const std::string& folder) {
    std::vector<mrpt::math::CMatrix_u16> depths;
    readLog(scratch_ / folder + "/small.rawlog", [&](const mrpt::obs::CObservation& observation) {
      if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation))
        depths.push_back(scan->rangeImage);
    });
    return depths;
  };
  EXPECT_TRUE(depthsOf("camera") == depthsOf("whole"));
  const auto poseAt = [&](const std::string& folder, double time) {
    const auto truth = omnimapper::eval::readTum(scratch_ / folder + "/truth.tum");
    const auto stamp = omnimapper::base::stampFromUnix(1.7e9 + time);
    return std::find_if(truth.begin(), truth.end(), [&](const auto& pose) { return pose.stamp == stamp; })
        ->world_from_body.translation;
  };
  EXPECT_EQ(poseAt("camera", 3), poseAt("others", 3));
}

TEST_F(Simulate, FramesHoldTheSameScansAndTheMotionBetweenThem) {
  ASSERT_TRUE(endedWith(ExitCode::ok, run("observations")));
  ASSERT_TRUE(endedWith(ExitCode::ok, run("frames", {"--set", "simulation.format=frames"})));
  EXPECT_EQ(countOf("frames", "laser"), countOf("observations", "laser"));
  EXPECT_EQ(countOf("frames", "camera"), countOf("observations", "camera"));
  double travel = 0;
  readLog(scratch_ / "frames/small.rawlog", [&](const mrpt::obs::CObservation& observation) {
    if (const auto* motion = dynamic_cast<const CObservationRelativeMotion*>(&observation))
      travel += motion->begin_from_end.norm();
  });
  const auto truth = omnimapper::eval::readTum(scratch_ / "frames/truth.tum");
  double true_travel = 0;
  for (std::size_t i = 1; i < truth.size(); ++i)
    true_travel += (truth[i].world_from_body.translation - truth[i - 1].world_from_body.translation).norm();
  EXPECT_GT(true_travel, 1);
  EXPECT_NEAR(travel, true_travel, 0.1 * true_travel);
}

TEST_F(Simulate, ExternalImagesAreTheSameDepths) {
  ASSERT_TRUE(endedWith(ExitCode::ok, run("embedded")));
  ASSERT_TRUE(endedWith(ExitCode::ok, run("external", {"--set", "simulation.images=external"})));
  EXPECT_LT(fs::file_size(scratch_ / "external/small.rawlog"), 0.5 * fs::file_size(scratch_ / "embedded/small.rawlog"));
  const auto depthsOf = [&](const std::string& folder) {
    std::vector<mrpt::math::CMatrix_u16> depths;
    readLog(scratch_ / folder + "/small.rawlog", [&](const mrpt::obs::CObservation& observation) {
      if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation)) {
        depths.push_back(scan->rangeImage);
        EXPECT_EQ(scan->intensityImage.getWidth(), 160U);
      }
    });
    return depths;
  };
  const auto embedded = depthsOf("embedded"), external = depthsOf("external");
  ASSERT_EQ(embedded.size(), 13U);
  ASSERT_EQ(external.size(), 13U);
  for (std::size_t i = 0; i < embedded.size(); ++i) EXPECT_TRUE(embedded[i] == external[i]) << i;
}

TEST_F(Simulate, AnotherSensorChangesNothingForTheOthers) {
  ASSERT_TRUE(endedWith(ExitCode::ok, run("three")));
  const auto two = run("two", {"--set", "simulation.sensors=odometry, laser"});
  ASSERT_TRUE(endedWith(ExitCode::ok, two));
  const std::string less = scratch_ / "less.ini";
  std::ofstream(less) << "[simulation]\nsensors = odometry, laser\n";
  EXPECT_TRUE(endedWith(ExitCode::ok, run("less", {"-i", less}), {"warning", "camera", "switched off"}));
  EXPECT_EQ(two.err.find("switched off"), std::string::npos)
      << "a list that --set shortens is meant to be short: " << two.err;
  const auto rangesOf = [&](const std::string& folder) {
    std::vector<float> ranges;
    readLog(scratch_ / folder + "/small.rawlog", [&](const mrpt::obs::CObservation& observation) {
      if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&observation))
        for (std::size_t i = 0; i < scan->getScanSize(); ++i) ranges.push_back(scan->getScanRange(i));
    });
    return ranges;
  };
  const auto three = rangesOf("three");
  EXPECT_FALSE(three.empty());
  EXPECT_TRUE(rangesOf("two") == three);
}

TEST_F(Simulate, LostMeasurementsAreCounted) {
  const auto ended = run("out", {"--set", "laser.dropout=0.5", "--set", "laser.rate_hz=40"});
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  const auto there = countOf("out", "laser");
  EXPECT_GT(there, 80U);
  EXPECT_LT(there, 160U);
  EXPECT_NE(
      ended.out.find("laser: " + std::to_string(there) + " measurements, " + std::to_string(241 - there) + " lost"),
      std::string::npos)
      << ended.out;
}

TEST_F(Simulate, AFolderUsedAgainHoldsTheNewRunAlone) {
  const Texts fewer{"--set", "simulation.sensors=laser", "--set", "simulation.duration_s=2", "--name", "other"};
  ASSERT_TRUE(endedWith(ExitCode::ok, run("twice", {"--set", "simulation.images=external"})));
  writeFile(scratch_ / "twice/notes.txt", "mine");
  ASSERT_TRUE(endedWith(ExitCode::ok, run("twice", fewer)));
  ASSERT_TRUE(endedWith(ExitCode::ok, run("once", fewer)));
  auto expected = contentOf(scratch_ / "once");
  expected["notes.txt"] = "mine";
  EXPECT_TRUE(contentOf(scratch_ / "twice") == expected);
  EXPECT_EQ(filesIn(scratch_ / "twice"),
            (std::set<std::string>{"other.rawlog", "other.ini", "truth.tum", "truth", "landmarks.json", "surfaces.json",
                                   "world.ply", "plan.svg", "pictures", "README.md", "notes.txt"}));
}

TEST_F(Simulate, ThePageOfTheFolderSaysWhatItsSensorsAreGoodFor) {
  const auto pageWith = [&](const std::string& sensors) {
    EXPECT_TRUE(endedWith(ExitCode::ok, run("page", {"--set", "simulation.sensors=" + sensors})));
    return readFile(scratch_ / "page/README.md");
  };
  const auto says = [](const std::string& page, const std::string& ini) { return page.find(ini) != std::string::npos; };
  const std::string laser = pageWith("laser, odometry"), camera = pageWith("camera, odometry"),
                    neither = pageWith("odometry");
  EXPECT_TRUE(says(laser, "-i laser2d.ini") && !says(laser, "perceive.ini")) << laser;
  EXPECT_TRUE(!says(camera, "laser2d.ini") && says(camera, "-i perceive.ini")) << camera;
  EXPECT_TRUE(!says(neither, "ini/") && says(neither, "--check")) << neither;
}

}  // namespace
