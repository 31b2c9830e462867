#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/SplitMix.h>
#include <omnimapper/testing/Fixtures.h>

#include <fstream>
#include <iterator>

#include "LogWriters.h"
#include "ros_log/Definition.h"
#include "ros_log/RosLog.h"

// Logs with random errors: each is read as far as it goes, or refused. More of them than a test run tries:
//   test-plugins --gtest_filter='RosMutation.*' --gtest_shuffle --gtest_repeat=50
namespace omnimapper::ros::ros_mutation_test {
namespace {

using namespace ros_test;

constexpr std::int64_t kStart = 1'600'000'000'000'000'000, kStep = 50'000'000;

const std::vector<Topic>& topics() {
  static const std::vector<Topic> all = [] {
    std::vector<Topic> made;
    for (const char* type : {"sensor_msgs/LaserScan", "nav_msgs/Odometry", "tf2_msgs/TFMessage",
                             "sensor_msgs/CameraInfo", "sensor_msgs/Image"})
      made.push_back({std::string("/camera/") + (type + std::string(type).find('/') + 1), type, usualDefinition(type)});
    made[3].name = "/camera/camera_info";
    return made;
  }();
  return all;
}

std::string imageMessage(std::int64_t time) {
  const std::string pixels(24, '\x11');
  Serializer out(true);
  out.header(time, "optical").uint(3, 4).uint(4, 4).text("16UC1").uint(0, 1).uint(8, 4);
  return out.uint(pixels.size(), 4).raw(pixels).bytes();
}

std::string infoMessage(std::int64_t time) {
  Serializer out(true);
  out.header(time, "optical").uint(3, 4).uint(4, 4).text("plumb_bob").uint(1, 4).real(0.1);
  out.reals(std::vector<double>(30, 2)).uint(0, 4).uint(0, 4).uint(0, 4).uint(0, 4).uint(0, 4).uint(0, 4).uint(0, 1);
  return out.bytes();
}

std::vector<Written> messages() {
  std::vector<Written> all;
  for (int i = 0; i < 12; ++i) {
    const std::int64_t time = kStart + i * kStep;
    const double x = 0.1 * i;
    all.push_back({0, time, scanBytes(true, time)});
    all.push_back({1, time, odometryBytes(true, time, "base_link", {x, 0, 0, 0, 0, 0, 1})});
    all.push_back({2, time, transformBytes(true, time, "base_link", "laser", {0, 0, x, 0, 0, 0, 1})});
    all.push_back({3, time, infoMessage(time)});
    all.push_back({4, time, imageMessage(time)});
  }
  return all;
}

std::size_t placeIn(std::size_t size, base::SplitMix& dice) {
  return static_cast<std::size_t>(dice.below(static_cast<int>(size)));
}

// One to four errors.
std::string mutated(std::string bytes, base::SplitMix& dice) {
  const std::uint32_t odd[] = {0, 1, 0x7f, 0xff, 0x7fffffff, 0x80000000, 0xffffffff, 0x10000000, 0x7ff00000, 0xfff};
  for (int left = 1 + dice.below(4); left > 0 && bytes.size() > 16; --left) {
    const std::size_t at = placeIn(bytes.size() - 8, dice);
    const int kind = dice.below(6);
    if (kind == 0) bytes[at] = static_cast<char>(dice.below(256));
    if (kind == 1) bytes[at] = static_cast<char>(bytes[at] ^ (1 << dice.below(8)));
    if (kind == 2) bytes.replace(at, 4, number(odd[dice.below(10)], 4));
    if (kind == 3) bytes.erase(at, 1 + placeIn(40, dice));
    if (kind == 4) bytes.insert(at, bytes.substr(placeIn(bytes.size(), dice), 1 + placeIn(200, dice)));
    if (kind == 5 && dice.below(4) == 0) bytes.resize(at);
  }
  return bytes;
}

// Reads a log, which may be refused with a reason.
void readOrRefuse(const std::string& path) {
  RosLogOptions options;
  options.truth_topic = "/camera/Odometry";
  try {
    RosLog log(path, options);
    std::size_t count = 0;
    while (log.next()) ++count;
    EXPECT_LE(count, 200u);
    EXPECT_NE(log.report().ending, source::SourceReport::Ending::open);
    log.truthAt(base::stampFromUnix(1.6e9));
  } catch (const base::Error& error) {
    EXPECT_NE(error.code(), base::ExitCode::internal) << error.what();
    EXPECT_NE(std::string(error.what()), "");
  }
}

class RosMutation : public ::testing::Test {
 protected:
  void tryAll(const std::string& bytes, const std::string& name, int count) {
    const std::string path = folder_ / name;
    const auto seed = static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed());
    for (int i = 0; i < count; ++i) {
      base::SplitMix dice(1'000'000 * seed + static_cast<std::uint64_t>(i));
      std::ofstream(path, std::ios::binary) << mutated(bytes, dice);
      SCOPED_TRACE(name + " with seed " + std::to_string(seed) + ", number " + std::to_string(i));
      readOrRefuse(path);
    }
  }
  testing::ScratchFolder folder_;
};

TEST_F(RosMutation, ofABagIsReadOrRefused) {
  BagWriter writer;
  writer.messages_in_chunk = 10;
  tryAll(writer.text(topics(), messages()), "a.bag", 150);
  writer.compression = "lz4";
  tryAll(writer.text(topics(), messages()), "b.bag", 60);
  writer.has_chunks = writer.is_indexed = false;
  tryAll(writer.text(topics(), messages()), "c.bag", 60);
}

TEST_F(RosMutation, ofAnMcapIsReadOrRefused) {
  McapWriter writer;
  writer.messages_in_chunk = 10;
  writer.has_chunks = false;
  tryAll(writer.text(topics(), messages()), "a.mcap", 150);
  writer.has_chunks = true;
  writer.compression = "zstd";
  tryAll(writer.text(topics(), messages()), "b.mcap", 60);
}

TEST_F(RosMutation, ofAnSqliteFileIsReadOrRefused) {
  const std::string path = folder_ / "whole.db3";
  Db3Writer().write(path, topics(), messages());
  std::ifstream in(path, std::ios::binary);
  const std::string whole(std::istreambuf_iterator<char>(in), {});
  tryAll(whole, "a.db3", 150);
}

}  // namespace
}  // namespace omnimapper::ros::ros_mutation_test
