#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/source/ObservationGate.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace omnimapper::mapper::replay_test {
namespace {

using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

mrpt::obs::CObservation::Ptr depthImage(base::Stamp stamp, int columns) {
  const auto image = mrpt::obs::CObservation3DRangeScan::Create();
  image->sensorLabel = "camera";
  image->timestamp = stamp;
  image->hasRangeImage = true;
  image->rangeImage.setZero(4, columns);
  image->cameraParams.ncols = static_cast<unsigned>(columns);
  image->cameraParams.nrows = 4;
  image->cameraParams.setIntrinsicParamsFromValues(5, 5, columns / 2.0, 2);
  return image;
}

/// A recording of a live run with some unusable observations: a motion that is not a number, and depth images of
/// another size than the camera's others, the last two right after the middle.
class Replay : public ::testing::Test {
 protected:
  Replay() {
    loadFeatures();
    testing::SimulatedLogOptions options;
    options.place = testing::SimulatedLogOptions::Place::box;
    all_ = testing::SimulatedLog(options).observations();
    all_.resize(400);
    const auto insert = [&](std::size_t at, const mrpt::obs::CObservation::Ptr& one) {
      all_.insert(all_.begin() + static_cast<std::ptrdiff_t>(at), one);
    };
    for (std::size_t at : {10, 11, 12, 13, 14}) insert(at, depthImage(all_[at]->timestamp, 8));
    for (std::size_t at : {201, 202}) insert(at, depthImage(all_[at]->timestamp, 6));
    const auto bad = mrpt::obs::CObservationOdometry::Create();
    bad->sensorLabel = "odometry";
    bad->timestamp = all_[50]->timestamp;
    bad->odometry.x(std::nan(""));
    insert(50, bad);
  }

  void write(const std::string& name, std::size_t first, std::size_t end) {
    source::writeRawlog(folder_ / name + ".rawlog", [&](source::RawlogWriter& log) {
      for (std::size_t i = first; i < end; ++i) log.add(*all_[i]);
    });
  }
  // Maps each usable observation as it came, except some that are left out.
  void writeJournal(const std::string& name, std::size_t lines = 1000) {
    std::ofstream file(folder_ / name + ".journal");
    file << "omnimapper journal 1\n";
    source::ObservationGate gate;
    std::size_t number = 0;
    for (const auto& one : all_)
      if (!gate.refuses(*one) && number++ < lines)
        file << ((number - 1) % 50 == 49 ? "d " : "a ") << number - 1 << "\n";
    EXPECT_EQ(number, all_.size() - 3) << "the motion and two depth images";
  }
  RunResult replayed(const std::string& name) {
    RunRequest request;
    request.replay = folder_ / name + ".journal";
    request.output_folder = folder_ / name + "_map";
    base::Progress silent;
    return runMapping(request, base::Config::fromText(testing::kLaserIni, "test.ini"), silent, [] { return false; });
  }

  testing::ScratchFolder folder_;
  Observations all_;
};

TEST_F(Replay, whatAJournalThatWasCutOffSaysNothingOfIsMappedToo) {
  write("whole", 0, all_.size());
  writeJournal("whole", 100);
  const auto result = replayed("whole");
  EXPECT_GT(result.key_frames, 10u);
  const auto& warnings = result.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.find("the journal ends 305 observations before its recording") != std::string::npos;
  })) << warnings.size();
}

TEST_F(Replay, aRecordingInSeveralFilesIsOne) {
  constexpr std::size_t kMiddle = 201;
  write("whole", 0, all_.size());
  writeJournal("whole");
  write("split", 0, kMiddle);
  write("split_001", kMiddle, all_.size());
  writeJournal("split");
  const auto whole = replayed("whole"), split = replayed("split");
  EXPECT_GT(whole.key_frames, 10u);
  EXPECT_EQ(split.key_frames, whole.key_frames);
  EXPECT_EQ(split.factors, whole.factors);
  EXPECT_EQ(split.travel, whole.travel);
  EXPECT_EQ(split.source.observations(), whole.source.observations());
  EXPECT_EQ(split.source.unusableCount(), 3u);
  EXPECT_EQ(split.source.ending, source::SourceReport::Ending::complete);
  EXPECT_EQ(split.code, whole.code);
}

}  // namespace
}  // namespace omnimapper::mapper::replay_test
