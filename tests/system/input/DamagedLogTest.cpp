// Logs that are truncated, corrupt, or contain objects that cannot be read: the map of what was readable is kept, and
// the exit code and message say what happened.
#include <mrpt/obs/CObservationImage.h>

#include <cstring>

#include "../MapFolder.h"
#include "../Rawlogs.h"

namespace {

using namespace runs;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::SimulatedLogOptions;
using rawlogs::Observations;

class DamagedLog : public ::testing::Test {
 protected:
  static SimulatedLogOptions box() {
    SimulatedLogOptions options;
    options.place = SimulatedLogOptions::Place::box;
    return options;
  }
  std::string file(const std::string& name) const { return scratch_ / name; }

  /// Maps the bytes of a log, of which only the first `objects` observations can be read.
  void expectMapOfWhatWasReadable(const std::string& bytes, std::size_t objects, ExitCode code, const Texts& words) {
    writeFile(log_path_, bytes);
    expectMapOfWhatWasReadable(objects, code, words);
  }
  void expectMapOfWhatWasReadable(std::size_t objects, ExitCode code, Texts words) {
    words.push_back(log_path_);
    ASSERT_TRUE(endedWith(code, map({log_path_}, folder_), words));
    EXPECT_EQ(filesIn(folder_), allOutputs());
    const auto trajectory = loadTrajectory(folder_);
    std::vector<omnimapper::base::Stamp> readable;
    for (std::size_t i = 0; i < objects; ++i) {
      if (observations_[i]->sensorLabel == "laser") readable.push_back(observations_[i]->timestamp);
    }
    EXPECT_EQ(stampsOf(trajectory), readable);
    EXPECT_LT(errorAgainst(log_, trajectory), 0.1);
    EXPECT_GT(loadMap(folder_).map.key_frames.size(), 3U);
    const auto warnings = loadSummary(folder_)["warnings"].dump();
    EXPECT_NE(warnings.find(words.front()), std::string::npos) << "the summary has the warning, too: " << warnings;
  }

  ScratchFolder scratch_;
  SimulatedLog log_{box()};
  Observations observations_ = log_.observations();
  rawlogs::Bytes bytes_ = rawlogs::bytesOf(observations_);
  std::string log_path_ = file("walk.rawlog"), folder_ = file("map");
};

TEST_F(DamagedLog, TruncatedPlainLogsGiveTheMapUpToTheCut) {
  for (const double part : {0.3, 0.95}) {
    const auto object = static_cast<std::size_t>(part * static_cast<double>(bytes_.starts.size()));
    const std::size_t cut = (bytes_.starts[object] + bytes_.starts[object + 1]) / 2;
    expectMapOfWhatWasReadable(bytes_.text.substr(0, cut), object, ExitCode::damaged_input, {"truncated"});
  }
}

TEST_F(DamagedLog, TruncatedGzipLogsGiveTheMapOfWhatUnpacks) {
  rawlogs::writeGzip(log_path_, bytes_.text);
  const std::string gzip = readFile(log_path_);
  for (const double part : {0.4, 0.8}) {
    writeFile(log_path_, gzip.substr(0, static_cast<std::size_t>(part * static_cast<double>(gzip.size()))));
    ASSERT_TRUE(endedWith(ExitCode::damaged_input, map({log_path_}, folder_), {"truncated", log_path_}));
    const auto scans = scanStamps(log_);
    const auto found = stampsOf(loadTrajectory(folder_));
    EXPECT_NEAR(static_cast<double>(found.size()), part * static_cast<double>(scans.size()),
                0.1 * static_cast<double>(scans.size()));
    EXPECT_TRUE(std::equal(found.begin(), found.end(), scans.begin()));
    EXPECT_EQ(filesIn(folder_), allOutputs());
  }
}

TEST_F(DamagedLog, ACutBeforeAnythingCanBeMappedLeavesAnOlderMapAlone) {
  writeFile(log_path_, bytes_.text);
  ASSERT_TRUE(endedWith(ExitCode::ok, map({log_path_}, folder_)));
  const std::string before = readFile(folder_ + "/map.omnimap");
  writeFile(log_path_, bytes_.text.substr(0, bytes_.starts[1] / 2 + bytes_.starts[1]));
  EXPECT_TRUE(
      endedWith(ExitCode::damaged_input, map({log_path_}, folder_), {log_path_, "nothing to map", "truncated"}));
  EXPECT_TRUE(readFile(folder_ + "/map.omnimap") == before);
}

TEST_F(DamagedLog, AnOverwrittenPlaceInAPlainLogEndsTheMapThere) {
  const std::size_t object = bytes_.starts.size() / 2;
  std::string damaged = bytes_.text;
  damaged.replace(bytes_.starts[object], 300, std::string(300, '\xff'));
  expectMapOfWhatWasReadable(damaged, object, ExitCode::damaged_input, {"cannot be read"});
}

TEST_F(DamagedLog, AFlippedBitInAGzipLogIsNeverTakenForGood) {
  rawlogs::writeGzip(log_path_, bytes_.text);
  std::string gzip = readFile(log_path_);
  gzip[gzip.size() / 2] = static_cast<char>(gzip[gzip.size() / 2] ^ 0x10);
  writeFile(log_path_, gzip);
  EXPECT_TRUE(endedWith(ExitCode::damaged_input, map({log_path_}, folder_), {log_path_, "cannot be read"}));
  EXPECT_GT(loadMap(folder_).map.key_frames.size(), 5U);
}

TEST_F(DamagedLog, AClassNobodyRegisteredEndsTheMapThereAndIsNamed) {
  const std::size_t object = bytes_.starts.size() / 2;
  const std::string prefix = "mrpt::obs::CObservation";
  const auto name = bytes_.text.find(prefix, bytes_.starts[object]);
  ASSERT_LT(name, bytes_.starts[object + 1]);
  std::string foreign = bytes_.text;
  foreign.replace(name + prefix.size(), 4, "Tele");  // the length of the name stays
  expectMapOfWhatWasReadable(foreign, object, ExitCode::unregistered_class,
                             {"CObservationTele", "not registered", "load the library"});
}

TEST_F(DamagedLog, OneDamagedLogOfTwoIsReportedAndBothAreMapped) {
  Observations lasers, odometry;
  for (const auto& o : observations_) (o->sensorLabel == "laser" ? lasers : odometry).push_back(o);
  const auto whole = rawlogs::bytesOf(odometry).text;
  const auto cut = rawlogs::bytesOf(lasers);
  const std::size_t half = cut.starts.size() / 2;
  writeFile(file("odometry.rawlog"), whole);
  writeFile(log_path_, cut.text.substr(0, cut.starts[half] + 100));
  EXPECT_TRUE(
      endedWith(ExitCode::damaged_input, map({file("odometry.rawlog"), log_path_}, folder_), {"truncated", log_path_}));
  EXPECT_EQ(loadTrajectory(folder_).size(), half);
}

TEST_F(DamagedLog, MissingImagesLeaveTheirObservationsOutAndTheRestIsMapped) {
  for (int i = 0; i < 3; ++i) {
    auto image = mrpt::obs::CObservationImage::Create();
    image->sensorLabel = "camera";
    image->timestamp = observations_[100]->timestamp + omnimapper::base::durationFromSeconds(0.001 * (i + 1));
    image->image.setExternalStorage("camera_" + std::to_string(i) + ".jpg");
    observations_.insert(observations_.begin() + 101 + i, image);
  }
  writeFile(log_path_, rawlogs::bytesOf(observations_).text);
  EXPECT_TRUE(endedWith(ExitCode::missing_images, map({log_path_}, folder_),
                        {"3 observations", file("walk_Images/camera_0.jpg"), "images_folder"}));
  EXPECT_EQ(stampsOf(loadTrajectory(folder_)), scanStamps(log_));
}

TEST_F(DamagedLog, ALogWithoutAnythingToMapIsAnErrorThatSaysWhatItHolds) {
  Observations odometry;
  for (const auto& o : observations_) {
    if (o->sensorLabel == "odometry") odometry.push_back(o);
  }
  writeFile(log_path_, rawlogs::bytesOf(odometry).text);
  EXPECT_TRUE(endedWith(ExitCode::nothing_to_map, map({log_path_}, folder_),
                        {log_path_, "nothing to map", "laser2d.ini", "CObservationOdometry"}));
  EXPECT_EQ(filesIn(folder_), std::set<std::string>{});
}

TEST_F(DamagedLog, WhatIsNoRawlogIsRefusedAndNothingIsWritten) {
  const auto refused = [&](const std::string& path, const std::string& why) {
    EXPECT_TRUE(endedWith(ExitCode::unreadable_input, map({path}, folder_), {path, why}));
    EXPECT_FALSE(fs::exists(folder_)) << path;
  };
  refused(writeFile(file("notes.txt"), "Dear diary,\ntoday we mapped.\n"), "text");
  refused(writeFile(file("picture.png"), "\x89PNG\r\n\x1a\n" + std::string(500, '\3')), "image");
  refused(writeFile(file("empty.rawlog"), ""), "empty");
  refused(writeFile(file("noise.rawlog"), std::string(5000, '\x5a')), "");
  refused(file("nowhere.rawlog"), "No such file");
  refused(scratch_.path(), "folder");
}

TEST_F(DamagedLog, ALogOfAnotherFormatIsReadToItsDamage) {
  const auto path = writeFile(file("log.clf"), "ODOM 0 0 0 0 0 0 1.0 nohost 0\nODOM 0 0 0 0\n");
  EXPECT_TRUE(endedWith(ExitCode::damaged_input, map({path}, folder_), {path, "line 2"}));
}

}  // namespace
