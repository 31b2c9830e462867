#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/Program.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "RangeScans.h"

/// MRPT's own driver of an Xtion before a driver of OpenNI2 that plays a log.
namespace omnimapper::drivers::xtion_test {
namespace {

const std::string kOpenNi2 = OMNIMAPPER_OPENNI2_FOLDER;  // of the build, where OpenNI2 finds that driver alone
const std::string kIni =
    "[live]\nsensors = xtion\nreopen_after_s = 1\n[xtion]\ndriver = COpenNI2Sensor\nsensorLabel = XTION\nwidth = "
    "640\nheight = 480\nfps = "
    "30\n"
    "grab_3D_points = false\nrelativePoseIntensityWRTDepth = [0 0 0 -90 0 -90]\n";

class XtionTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kOpenNi2.empty()) GTEST_SKIP() << "this was built without OpenNI2 (Debian's libopenni2-dev)";
  }

  // A log of so many images, a tenth of a second apart, which the device plays.
  void makeLog(std::size_t count) {
    played = range_scans::simulated(count);
    ASSERT_EQ(played.size(), count);
    source::writeRawlog(folder / "played.rawlog", [&](source::RawlogWriter& log) {
      for (const auto& scan : played) log.add(*scan);
    });
  }

  testing::Ended record(double seconds, int count, const std::string& words, const std::string& unplugged = "",
                        const std::string& keys = "") {
    std::filesystem::remove_all(folder / "out");
    std::ofstream(folder / "live.ini") << kIni << keys;
    std::vector<std::string> argv{"env", "LD_LIBRARY_PATH=" + kOpenNi2};
    if (!played.empty()) argv.push_back("OMNIMAPPER_PLAYED_LOG=" + folder / "played.rawlog");
    if (!unplugged.empty()) argv.push_back("OMNIMAPPER_UNPLUGGED_S=" + unplugged);
    for (const auto& word : {testing::ownProgram("live-record"), folder / "live.ini", folder / "out",
                             std::to_string(seconds), std::to_string(count), words})
      argv.push_back(word);
    return testing::runProgram(argv);
  }

  // Which of the played images it is, by its depths in whole millimetres.
  std::optional<std::size_t> depthsOf(const range_scans::Scan& seen) const {
    for (std::size_t i = 0; i < played.size(); ++i) {
      bool is_same = true;
      for (int row = 0; row < 480 && is_same; ++row) {
        for (int column = 0; column < 640 && is_same; ++column) {
          const double depth = played[i]->rangeImage(row, column) * static_cast<double>(played[i]->rangeUnits);
          const double got = seen.rangeImage(row, column) * static_cast<double>(seen.rangeUnits);
          is_same = std::abs(got - depth) < 0.000501;
        }
      }
      if (is_same) return i;
    }
    return std::nullopt;
  }

  testing::ScratchFolder folder;
  range_scans::Scans played;
};

TEST_F(XtionTest, whatIsPlayedArrivesInMillimetres) {
  makeLog(6);
  const auto ended = record(20, 5, "is lost");
  EXPECT_EQ(ended.code, 0) << testing::toString(ended);
  const auto scans = range_scans::recorded<range_scans::Scan>(folder / "out/log.rawlog");
  ASSERT_GE(scans.size(), 3u) << testing::toString(ended);
  for (const auto& scan : scans) {
    EXPECT_EQ(scan->sensorLabel, "XTION");
    EXPECT_NEAR(scan->cameraParams.fx(), 525, 0.5);
    const auto depths = depthsOf(*scan);
    ASSERT_TRUE(depths);
    std::size_t picture = 0;
    while (picture < played.size() && !range_scans::isSamePicture(*scan, *played[picture])) ++picture;
    ASSERT_LT(picture, played.size());
    EXPECT_LE(std::abs(static_cast<int>(*depths) - static_cast<int>(picture)), 1);
  }
}

TEST_F(XtionTest, anXtionThatIsUnpluggedIsToldAndOpenedAgain) {
  makeLog(2);
  const auto ended = record(20, 1000, "is back", "1");
  EXPECT_NE(ended.out.find("sensor [xtion] is lost: OpenNI2 says that the camera is gone"), std::string::npos)
      << testing::toString(ended);
  EXPECT_NE(ended.out.find("sensor [xtion] is back"), std::string::npos) << testing::toString(ended);
  EXPECT_EQ(ended.code, 0) << "no driver is left behind: " << testing::toString(ended);
}

// MRPT's driver would wait for ever.
TEST_F(XtionTest, anXtionThatFallsSilentIsToldAndOpenedAgain) {
  makeLog(2);
  const auto ended = record(30, 1000, "is back", "never");
  EXPECT_NE(ended.out.find("sensor [xtion] is lost: it has sent nothing for"), std::string::npos)
      << testing::toString(ended);
  EXPECT_NE(ended.out.find("sensor [xtion] is back"), std::string::npos) << testing::toString(ended);
  EXPECT_EQ(ended.code, 0) << "no driver is left behind: " << testing::toString(ended);
}

// MRPT's driver would end the program.
TEST_F(XtionTest, aCameraThatIsNotThereIsAnError) {
  auto ended = record(5, 1000, "is lost");
  EXPECT_EQ(ended.code, static_cast<int>(base::ExitCode::unreadable_input)) << testing::toString(ended);
  EXPECT_NE(ended.err.find("[xtion] (COpenNI2Sensor) cannot be opened: OpenNI2 finds no camera"), std::string::npos)
      << testing::toString(ended);
  makeLog(1);
  ended = record(5, 1000, "is lost", "", "device_number = 1\n");
  EXPECT_EQ(ended.code, static_cast<int>(base::ExitCode::unreadable_input)) << testing::toString(ended);
  EXPECT_NE(ended.err.find("there is no camera with device_number = 1"), std::string::npos) << testing::toString(ended);
}

}  // namespace
}  // namespace omnimapper::drivers::xtion_test
