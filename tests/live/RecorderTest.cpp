#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/live/Recorder.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "Observations.h"

namespace omnimapper::live::recorder_test {
namespace {

using namespace observations;
namespace fs = std::filesystem;

std::vector<double> positionsIn(const std::string& path) {
  source::RawlogSource log(path);
  std::vector<double> positions;
  while (const auto next = log.next())
    positions.push_back(std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(next)->odometry.x());
  return positions;
}

TEST(Recorder, whatIsEncodedIsReadAsItWas) {
  const auto decoded = decode(encode(odometry(3, 0.25)));
  const auto back = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(decoded);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->odometry.x(), 0.25);
  EXPECT_EQ(back->timestamp, at(3));
  EXPECT_EQ(back->sensorLabel, "wheels");
}

TEST(Recorder, aRawlogHasAllInOrder) {
  const testing::ScratchFolder folder;
  Recorder recorder(folder.path(), "log", {});
  for (int i = 0; i < 1000; ++i) recorder.add(encode(odometry(i, i)));
  recorder.close();
  const auto positions = positionsIn(folder / "log.rawlog");
  ASSERT_EQ(positions.size(), 1000u);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(positions[static_cast<std::size_t>(i)], i);
  EXPECT_EQ(recorder.statistics().observations, 1000u);
  EXPECT_EQ(recorder.statistics().bytes_on_disk, fs::file_size(folder / "log.rawlog"));
  EXPECT_EQ(recorder.failure(), "");
}

// A copy of the file while it is being written is the same as the file that stays if the writer is killed at that time.
TEST(Recorder, allButTheLastSecondCanBeReadAtAnyTime) {
  const testing::ScratchFolder folder;
  Recorder recorder(folder.path(), "log", {});
  for (int i = 0; i < 100; ++i) recorder.add(encode(odometry(i, i)));
  std::this_thread::sleep_for(std::chrono::milliseconds(1200));
  recorder.add(encode(odometry(100, 100)));
  fs::copy_file(folder / "log.rawlog", folder / "killed.rawlog");
  EXPECT_GE(positionsIn(folder / "killed.rawlog").size(), 100u);
}

TEST(Recorder, aLongRecordingIsSplit) {
  const testing::ScratchFolder folder;
  RecorderOptions options;
  options.split_bytes = 1;
  Recorder recorder(folder.path(), "log", options);
  for (int i = 0; i < 2; ++i) {
    recorder.add(encode(odometry(i, i)));
    std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  }
  recorder.close();
  EXPECT_EQ(recorder.files(), (std::vector<std::string>{"log.rawlog", "log_001.rawlog"}));
  EXPECT_EQ(positionsIn(folder / "log.rawlog"), std::vector<double>{0});
  EXPECT_EQ(positionsIn(folder / "log_001.rawlog"), std::vector<double>{1});
}

TEST(Recorder, onAFullDiskWhatWasWrittenStays) {
  const testing::ScratchFolder folder;
  RecorderOptions options;
  options.compression = 0;
  Recorder recorder(folder.path(), "log", options);
  for (int i = 0; i < 10; ++i) recorder.add(encode(odometry(i, i)));
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  const testing::SmallFiles full(fs::file_size(folder / "log.rawlog") + 100);
  for (int i = 10; i < 100; ++i) recorder.add(encode(odometry(i, i)));
  recorder.close();
  EXPECT_NE(recorder.failure().find("log.rawlog: recording ended"), std::string::npos) << recorder.failure();
  EXPECT_EQ(positionsIn(folder / "log.rawlog").size(), 10u);
  recorder.add(encode(odometry(100, 100)));
}

TEST(Recorder, aRecordingIsNeverOverwritten) {
  const testing::ScratchFolder folder;
  { Recorder first(folder.path(), "log", {}); }
  EXPECT_THROW(Recorder(folder.path(), "log", {}), base::Error);
  EXPECT_THROW(Recorder(folder / "log.rawlog", "log", {}), base::Error) << "a file is no folder";
}

TEST(Recorder, whatIsDiscardedLeavesNothingOfItsOwn) {
  const testing::ScratchFolder folder;
  Recorder(folder / "new", "log", {}).discard();
  EXPECT_FALSE(fs::exists(folder / "new"));
  Recorder(folder.path(), "log", {}).discard();
  EXPECT_TRUE(fs::exists(folder.path())) << "the folder existed before";
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Recorder, saysWhenItsQueueIsFull) {
  const testing::ScratchFolder folder;
  RecorderOptions options;
  options.queue_bytes = 1000;
  Recorder recorder(folder.path(), "log", options);
  EXPECT_TRUE(recorder.hasRoomFor(5000)) << "an empty queue has room for an observation of any size";
  recorder.add(std::make_shared<const std::vector<std::uint8_t>>(*encode(odometry(0))));
  EXPECT_FALSE(recorder.hasRoomFor(5000));
}

}  // namespace
}  // namespace omnimapper::live::recorder_test
