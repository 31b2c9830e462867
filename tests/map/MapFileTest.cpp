#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/FramesBytes.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace map_file_test {
namespace {

using mrpt::poses::CPose3D;
using namespace omnimapper;

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

void overwrite(const std::string& path, const std::string& content) {
  std::filesystem::remove(path);
  std::ofstream(path, std::ios::binary) << content;
}

/// The error of reading `path`, as text; empty if it can be read.
std::string refusal(const std::string& path) {
  try {
    map::MapFile::read(path);
    return {};
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unreadable_input) << error.what();
    return error.what();
  }
}

map::MapFile smallFile() {
  map::MapFile file;
  file.set({"graph", 3, std::string("\0\1\2 bytes", 9)});
  file.set({"frames", 1, ""});
  file.set({"walls", 7, "of a plugin that is not there"});
  return file;
}

/// Poses from long products, which angles or quaternions would not reproduce in every bit.
map::Map awkwardMap() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto pose = [&] {
    CPose3D result;
    for (int i = 0; i < 20; ++i) {
      result = result + CPose3D(any(random), any(random), any(random), 3 * any(random), any(random), 3 * any(random));
    }
    return result;
  };
  map::Map map;
  for (std::uint32_t i = 0; i < 5; ++i) {
    map::KeyFrame frame;
    frame.id = {1, i};
    frame.stamp = base::stampFromUnix(1.1e9 + 0.1234567 * i);
    frame.pose = {1, 10 + i};
    frame.map_from_base = pose();
    frame.keyframe_from_next = pose();
    for (int h = 0; h < 3; ++h) frame.dependents.push_back({frame.stamp + base::Duration(h + 1), pose()});
    auto scan = mrpt::obs::CObservation2DRangeScan::Create();
    scan->sensorLabel = "LASER";
    scan->timestamp = frame.stamp;
    scan->sensorPose = pose();
    scan->resizeScan(4);
    for (std::size_t beam = 0; beam < 4; ++beam) {
      scan->setScanRange(beam, static_cast<float>(1.1 + any(random)));
      scan->setScanRangeValidity(beam, beam != 2);
    }
    frame.observations.push_back(scan);
    auto given_pose = mrpt::obs::CObservationRobotPose::Create();
    given_pose->pose.mean = pose();
    frame.observations.push_back(given_pose);
    for (int p = 0; p < 3; ++p)
      frame.cloud.push_back({static_cast<std::int16_t>(-32000 + p), 0, 31000, 255, static_cast<std::uint8_t>(p), 7});
    map.key_frames.insert(frame);
  }
  return map;
}

TEST(MapFile, readsBackWhatWasWrittenInOrder) {
  omnimapper::testing::ScratchFolder folder;
  smallFile().write(folder / "map.omnimap");
  const auto file = map::MapFile::read(folder / "map.omnimap");
  ASSERT_EQ(file.sections().size(), 3u);
  EXPECT_EQ(file.sections()[0].name, "graph");
  EXPECT_EQ(file.sections()[0].bytes, std::string("\0\1\2 bytes", 9));
  ASSERT_NE(file.find("walls"), nullptr);
  EXPECT_EQ(file.find("walls")->version, 7u);
  EXPECT_EQ(file.find("signs"), nullptr);
}

TEST(MapFile, settingASectionReplacesItInItsPlaceAndKeepsStrangers) {
  omnimapper::testing::ScratchFolder folder;
  smallFile().write(folder / "a.omnimap");
  auto file = map::MapFile::read(folder / "a.omnimap");
  file.set({"graph", 4, "new"});
  file.write(folder / "b.omnimap");
  const auto again = map::MapFile::read(folder / "b.omnimap");
  ASSERT_EQ(again.sections().size(), 3u);
  EXPECT_EQ(again.sections()[0].bytes, "new");
  EXPECT_EQ(again.find("walls")->bytes, "of a plugin that is not there");
}

TEST(MapFile, saveLoadSaveIsTheSameFile) {
  omnimapper::testing::ScratchFolder folder;
  map::MapFile file = smallFile();
  file.set(map::framesToSection(awkwardMap()));
  file.write(folder / "a.omnimap");
  auto loaded = map::MapFile::read(folder / "a.omnimap");
  loaded.set(map::framesToSection(map::framesFromSection(*loaded.find("frames"))));
  loaded.write(folder / "b.omnimap");
  EXPECT_EQ(contentOf(folder / "a.omnimap"), contentOf(folder / "b.omnimap"));
}

TEST(MapFile, manyKeyFramesAreSeveralBlocksAndSmallerThanTheirBytes) {
  map::Map map;
  for (std::uint32_t i = 0; i < 300; ++i) {
    map::KeyFrame frame;
    frame.id = {0, i};
    frame.stamp = base::stampFromUnix(1e9 + i);
    auto scan = mrpt::obs::CObservation2DRangeScan::Create();
    scan->resizeScan(4000);
    for (std::size_t beam = 0; beam < 4000; ++beam) scan->setScanRange(beam, static_cast<float>(i));
    frame.observations.push_back(scan);
    map.key_frames.insert(frame);
  }
  const auto section = map::framesToSection(map);
  EXPECT_GT(map::uncompressedSize(section), 300U * 4000 * 4);
  EXPECT_LT(section.bytes.size(), map::uncompressedSize(section) / 10);
  const auto again = map::framesFromSection(section);
  ASSERT_EQ(again.key_frames.size(), 300U);
  EXPECT_EQ(dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(*again.key_frames[299].observations[0])
                .getScanRange(3999),
            299);
}

TEST(MapFile, aBlockThatStatesMoreThanItsBytesHoldIsRefused) {
  auto section = map::framesToSection(awkwardMap());
  for (const std::size_t at : {4, 12, 40, 50}) {
    auto damaged = section;
    damaged.bytes[at + 2] = '\x7f';
    EXPECT_THROW(map::framesFromSection(damaged), base::Error) << at;
  }
}

TEST(MapFile, anyCutIsNoticed) {
  omnimapper::testing::ScratchFolder folder;
  smallFile().write(folder / "map.omnimap");
  const std::string content = contentOf(folder / "map.omnimap");
  for (std::size_t length = 0; length < content.size(); ++length) {
    overwrite(folder / "cut.omnimap", content.substr(0, length));
    EXPECT_NE(refusal(folder / "cut.omnimap"), "") << "cut to " << length << " bytes";
  }
  overwrite(folder / "cut.omnimap", content.substr(0, content.size() - 1));
  EXPECT_NE(refusal(folder / "cut.omnimap").find("section \"walls\": truncated"), std::string::npos);
  overwrite(folder / "long.omnimap", content + "x");
  EXPECT_NE(refusal(folder / "long.omnimap").find("goes on"), std::string::npos);
}

TEST(MapFile, anyFlippedBitIsNoticed) {
  omnimapper::testing::ScratchFolder folder;
  smallFile().write(folder / "map.omnimap");
  const std::string content = contentOf(folder / "map.omnimap");
  for (std::size_t i = 0; i < content.size() * 8; ++i) {
    std::string damaged = content;
    damaged[i / 8] = static_cast<char>(damaged[i / 8] ^ (1 << (i % 8)));
    overwrite(folder / "flipped.omnimap", damaged);
    EXPECT_NE(refusal(folder / "flipped.omnimap"), "") << "bit " << i;
  }
  std::string damaged = content;
  damaged[content.find(" bytes")] = '!';
  overwrite(folder / "flipped.omnimap", damaged);
  EXPECT_NE(refusal(folder / "flipped.omnimap").find("section \"graph\": its checksum"), std::string::npos);
}

TEST(MapFile, whatIsNoMapOrNotThereIsRefusedByName) {
  omnimapper::testing::ScratchFolder folder;
  EXPECT_NE(refusal(folder / "absent.omnimap").find("absent.omnimap: this map file cannot be opened"),
            std::string::npos);
  overwrite(folder / "text.omnimap", "VERTEX_SE2 0 0 0 0\n");
  EXPECT_NE(refusal(folder / "text.omnimap").find("is no map file"), std::string::npos);
}

TEST(MapFile, aLaterFormatIsRefusedWithARemedy) {
  omnimapper::testing::ScratchFolder folder;
  smallFile().write(folder / "map.omnimap");
  std::string content = contentOf(folder / "map.omnimap");
  content[8] = 2;  // the format version follows the magic of 8 bytes
  overwrite(folder / "map.omnimap", content);
  EXPECT_NE(refusal(folder / "map.omnimap").find("written in format 2, and this program reads format 1"),
            std::string::npos);
}

TEST(MapFile, aFullDiskIsAnErrorAndKeepsTheOldMap) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "/dev/full is not on this machine";
  EXPECT_THROW(smallFile().write("/dev/full/map.omnimap"), base::Error);
  omnimapper::testing::ScratchFolder folder;
  smallFile().write(folder / "map.omnimap");
  const std::string before = contentOf(folder / "map.omnimap");
  try {
    const omnimapper::testing::SmallFiles full(16);
    smallFile().write(folder / "map.omnimap");
    FAIL() << "no error";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::disk_full);
    EXPECT_NE(std::string(error.what()).find("map.omnimap"), std::string::npos);
  }
  EXPECT_EQ(contentOf(folder / "map.omnimap"), before);
}

TEST(FramesSection, keepsEveryBitOfPosesStampsAndObservations) {
  const map::Map map = awkwardMap();
  const map::Map loaded = map::framesFromSection(map::framesToSection(map));
  ASSERT_EQ(loaded.key_frames.size(), map.key_frames.size());
  for (std::size_t i = 0; i < map.key_frames.size(); ++i) {
    const map::KeyFrame &a = map.key_frames[i], &b = loaded.key_frames[i];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.pose, b.pose);
    EXPECT_EQ(a.stamp, b.stamp);
    EXPECT_EQ(a.map_from_base.getRotationMatrix(), b.map_from_base.getRotationMatrix());
    EXPECT_EQ(a.keyframe_from_next.m_coords, b.keyframe_from_next.m_coords);
    ASSERT_EQ(b.dependents.size(), 3u);
    EXPECT_EQ(a.dependents[2].stamp, b.dependents[2].stamp);
    EXPECT_EQ(a.dependents[2].keyframe_from_base.getRotationMatrix(),
              b.dependents[2].keyframe_from_base.getRotationMatrix());
    ASSERT_EQ(b.observations.size(), 2u);
    ASSERT_EQ(b.cloud.size(), 3u);
    EXPECT_EQ(b.cloud[2].x, -31998);
    EXPECT_EQ(b.cloud[2].z, 31000);
    EXPECT_EQ(b.cloud[2].green, 2);
    const auto scan = std::dynamic_pointer_cast<const mrpt::obs::CObservation2DRangeScan>(b.observations[0]);
    ASSERT_TRUE(scan);
    const auto& original = dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(*a.observations[0]);
    EXPECT_EQ(scan->sensorPose.getRotationMatrix(), original.sensorPose.getRotationMatrix());
    EXPECT_FALSE(scan->getScanRangeValidity(2));
    EXPECT_EQ(scan->timestamp, a.stamp);
  }
}

TEST(FramesSection, laterVersionsAndStrangeBytesAreRefused) {
  map::MapSection section = map::framesToSection(awkwardMap());
  section.version = 4;
  EXPECT_THROW(map::framesFromSection(section), base::Error);
  section.version = 3;
  section.bytes.pop_back();
  EXPECT_THROW(map::framesFromSection(section), base::Error);
  EXPECT_THROW(map::framesFromSection({"frames", 1, "??"}), base::Error);
  EXPECT_THROW(map::framesFromSection({"graph", 1, ""}), base::Error);
  // An observation of a class that is not registered.
  std::string bytes = omnimapper::testing::unpackedFrames(map::framesToSection(awkwardMap()));
  bytes.replace(bytes.find("CObservationRobotPose"), 21, "CObservationRobotPast");
  section = omnimapper::testing::packedFrames(3, bytes);
  try {
    map::framesFromSection(section);
    FAIL() << "no error";
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("frames"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("CObservationRobotPast"), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line: " << error.what();
  }
  // Its trajectory can be read all the same.
  const map::Map whole = awkwardMap(), bare = map::bareFramesFromSection(section);
  ASSERT_EQ(bare.key_frames.size(), whole.key_frames.size());
  for (std::size_t i = 0; i < whole.key_frames.size(); ++i) {
    const map::KeyFrame &a = bare.key_frames[i], &b = whole.key_frames[i];
    EXPECT_EQ(a.stamp, b.stamp);
    EXPECT_EQ(a.map_from_base.getRotationMatrix(), b.map_from_base.getRotationMatrix());
    EXPECT_EQ(a.dependents.size(), b.dependents.size());
    EXPECT_EQ(a.reference, b.reference);
    EXPECT_TRUE(a.observations.empty() && a.cloud.empty());
  }
}

}  // namespace
}  // namespace map_file_test
