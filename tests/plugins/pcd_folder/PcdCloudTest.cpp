#include <gtest/gtest.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include "pcd_folder/PcdCloud.h"
#include "pcd_folder/PcdFolder.h"

namespace omnimapper::source::pcd_cloud_test {
namespace {

class PcdCloudTest : public ::testing::Test {
 protected:
  std::string header(const std::string& data, const std::string& size = "WIDTH 2\nHEIGHT 2\n") const {
    return "# .PCD v0.7\nVERSION 0.7\nFIELDS label x y z rgb\nSIZE 4 4 4 4 4\nTYPE U F F F F\nCOUNT 1 1 1 1 1\n" +
           size + "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA " + data + "\n";
  }
  PcdCloud read(const std::string& bytes) {
    std::ofstream(path_, std::ios::binary) << bytes;
    return readPcd(path_);
  }
  std::string failure(const std::string& bytes) {
    try {
      read(bytes);
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      return error.what();
    }
    return "no failure";
  }
  template <class Number>
  static void put(std::string& bytes, Number number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  // Four points, the last of which is not a number.
  static std::string points(bool field_by_field) {
    const std::uint32_t labels[] = {1, 20, 30, 0}, rgb[] = {0xFF102030, 0xFF405060, 0, 1};
    const float nan = std::nanf(""), x[] = {0, 1, 2, nan}, y[] = {3, 4, 5, nan}, z[] = {6, 7, 8, nan};
    std::string bytes;
    if (field_by_field) {
      for (const auto label : labels) put(bytes, label);
      for (const float* field : {x, y, z})
        for (int i = 0; i < 4; ++i) put(bytes, field[i]);
      for (const auto colour : rgb) put(bytes, colour);
    } else {
      for (int i = 0; i < 4; ++i) {
        put(bytes, labels[i]);
        for (const float* field : {x, y, z}) put(bytes, field[i]);
        put(bytes, rgb[i]);
      }
    }
    return bytes;
  }
  static void expectPoints(const PcdCloud& cloud) {
    EXPECT_EQ(cloud.width, 2);
    EXPECT_EQ(cloud.height, 2);
    ASSERT_EQ(cloud.z.size(), 4U);
    EXPECT_EQ(cloud.x[1], 1);
    EXPECT_EQ(cloud.y[1], 4);
    EXPECT_EQ(cloud.z[2], 8);
    EXPECT_TRUE(std::isnan(cloud.z[3]));
    EXPECT_EQ(cloud.labels, (std::vector<std::uint32_t>{1, 20, 30, 0}));
    EXPECT_EQ(cloud.rgb[0], 0x102030U);
    EXPECT_EQ(cloud.rgb[1], 0x405060U);
  }

  testing::ScratchFolder folder_;
  const std::string path_ = folder_ / "x.pcd";
};

TEST_F(PcdCloudTest, binaryIsReadPointByPoint) {
  expectPoints(read(header("binary") + points(false)));
}

TEST_F(PcdCloudTest, compressedIsReadFieldByField) {
  const std::string plain = points(true);
  std::string literal;  // runs of literal bytes
  for (std::size_t i = 0; i < plain.size(); i += 32) {
    const std::string run = plain.substr(i, 32);
    literal += static_cast<char>(run.size() - 1) + run;
  }
  std::string sizes;
  put(sizes, static_cast<std::uint32_t>(literal.size()));
  put(sizes, static_cast<std::uint32_t>(plain.size()));
  expectPoints(read(header("binary_compressed") + sizes + literal));
  EXPECT_NE(failure(header("binary_compressed") + sizes + literal.substr(0, 20)).find("too early"), std::string::npos);
}

TEST_F(PcdCloudTest, repetitionsAreUnfolded) {
  // One field of 24 bytes: "ab", then 9 bytes and 13 bytes repeated from two back.
  std::string data(
      "\x01"
      "ab",
      3);
  data += std::string("\xE0\x00\x01", 3) + std::string("\xE0\x04\x01", 3);
  std::string sizes;
  put(sizes, static_cast<std::uint32_t>(data.size()));
  put(sizes, std::uint32_t{24});
  const std::string top =
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nDATA binary_compressed\n";
  const auto cloud = read(top + sizes + data);
  float expected = 0;
  std::memcpy(&expected, "abab", 4);
  for (const auto* field : {&cloud.x, &cloud.y, &cloud.z}) EXPECT_EQ(*field, std::vector<float>(2, expected));
  EXPECT_TRUE(cloud.labels.empty() && cloud.rgb.empty());
}

TEST_F(PcdCloudTest, textIsReadToo) {
  const auto cloud = read(header("ascii") + "1 0 3 6 0\n20 1 4 7 1e-40\n30 2 5 8 0\n0 nan nan nan 0\n");
  EXPECT_EQ(cloud.labels[1], 20U);
  EXPECT_EQ(cloud.z[2], 8);
  EXPECT_TRUE(std::isnan(cloud.x[3]));
  EXPECT_EQ(cloud.rgb[1], 71362U) << "the bits of 1e-40";
}

TEST_F(PcdCloudTest, numbersThatAreNoWholeOnesAreNoLabels) {
  const auto text = read(header("ascii") + "nan 0 3 6 0\n1e300 1 4 7 0\n-inf 2 5 8 0\n7 0 0 0 0\n");
  EXPECT_EQ(text.labels, (std::vector<std::uint32_t>{0, 0, 0, 7}));
  EXPECT_EQ(text.z[2], 8);
  std::string bytes;
  for (const float label : {std::nanf(""), 1e30F, -1e30F, 7.F}) {
    for (const float number : {label, 0.F, 0.F, 0.F}) put(bytes, number);
  }
  const std::string floats = "FIELDS label x y z\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n";
  EXPECT_EQ(read(floats + "WIDTH 4\nHEIGHT 1\nDATA binary\n" + bytes).labels, (std::vector<std::uint32_t>{0, 0, 0, 7}));
}

TEST_F(PcdCloudTest, aHeaderThatStatesAHugeSizeTakesNoMemory) {
  // 2^24 points of 252 bytes, and no data.
  const std::string top =
      "FIELDS x y z rest\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 60\nWIDTH 16777216\nHEIGHT 1\n"
      "DATA binary_compressed\n";
  std::string sizes;
  put(sizes, std::uint32_t{3});
  put(sizes, std::uint32_t{16777216U * 252U});
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  rlimit tight = before;
  tight.rlim_cur = std::min<rlim_t>(before.rlim_cur, rlim_t{2} << 30);
  if (!testing::kIsSanitized) {
    ASSERT_EQ(setrlimit(RLIMIT_AS, &tight), 0);
  }
  const std::string message = failure(top + sizes +
                                      std::string("\x01"
                                                  "ab",
                                                  3));
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_NE(message.find("damaged"), std::string::npos) << message;
}

TEST_F(PcdCloudTest, whatIsNoCloudIsRefused) {
  EXPECT_NE(failure("").find("no line DATA"), std::string::npos);
  EXPECT_NE(failure(header("morse")).find("'morse'"), std::string::npos);
  EXPECT_NE(failure(header("binary") + points(false).substr(1)).find("too early"), std::string::npos);
  EXPECT_NE(failure(header("ascii") + "1 2 3").find("too early"), std::string::npos);
  EXPECT_NE(failure(header("binary", "WIDTH 100000000\nHEIGHT 1\n")).find("more than 16777216 points"),
            std::string::npos);
  EXPECT_NE(
      failure("FIELDS a b\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nWIDTH 1\nDATA binary\n12345678").find("lacks a field x"),
      std::string::npos);
  EXPECT_THROW(readPcd(folder_ / "none.pcd"), base::Error);
}

TEST(PcdFolderTest, namesThatAreTimesAreTheStamps) {
  const std::string cloud =
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3\n";
  const auto stamps = [&](const std::vector<std::string>& names) {
    testing::ScratchFolder folder;
    for (const auto& name : names) std::ofstream(folder / name) << cloud;
    PcdFolder source(folder.path());
    std::vector<double> found;
    while (const auto scan = source.next()) found.push_back(mrpt::Clock::toDouble(scan->timestamp));
    return found;
  };
  const auto seconds = stamps({"1305031232.5.pcd", "1305031233.25.pcd"});
  EXPECT_NEAR(seconds[0], 1305031232.5, 1e-6);
  EXPECT_NEAR(seconds[1], 1305031233.25, 1e-6);
  EXPECT_NEAR(stamps({"1305031232500000000.pcd"})[0], 1305031232.5, 1e-6) << "nanoseconds";
  EXPECT_NEAR(stamps({"1305031232.5.pcd", "cloud.pcd"})[0], 1e9, 1) << "not all are times";
  for (const char* name : {"000017.pcd", "inf.pcd", "0x1p40.pcd", "20240131120000.pcd", "1305031232500.pcd", "1e9.pcd"})
    EXPECT_NEAR(stamps({name})[0], 1e9, 1) << name << " is no such time";
}

TEST(PcdFolderTest, aCloudWithoutRowsStaysACloudWithoutWhatIsNoPoint) {
  const testing::ScratchFolder folder;
  std::ofstream(folder / "scan.pcd")
      << "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\n"
         "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\nDATA ascii\n1 2 3\nnan nan nan\n4 5 6\n";
  PcdFolder source(folder.path());
  const auto cloud = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(source.next());
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->pointcloud->size(), 2U);
  float x, y, z;
  cloud->pointcloud->getPoint(1, x, y, z);
  EXPECT_EQ(x + 10 * y + 100 * z, 4 + 50 + 600);
  EXPECT_FALSE(source.next());
  EXPECT_EQ(source.report().ending, SourceReport::Ending::complete);
}

TEST(PcdRecording, tableTopScenesHaveLabels) {
  const auto path = testing::sharedData("objects/mosd/learn0.pcd");
  OMNIMAPPER_NEEDS(path);
  const auto cloud = readPcd(*path);
  EXPECT_EQ(cloud.width, 640);
  EXPECT_EQ(cloud.height, 480);
  EXPECT_EQ(std::count(cloud.labels.begin(), cloud.labels.end(), 20U), 20792);
  EXPECT_EQ(std::count_if(cloud.z.begin(), cloud.z.end(), [](float z) { return std::isnan(z); }), 124908);
}

}  // namespace
}  // namespace omnimapper::source::pcd_cloud_test
