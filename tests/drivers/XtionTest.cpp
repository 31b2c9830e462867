#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/testing/ChildProgram.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "PlayedScans.h"

/// Tests of the Xtion's driver with a driver of OpenNI2 that plays a log.
namespace omnimapper::drivers::xtion_test {
namespace {

const std::string kOpenNi2 = OMNIMAPPER_OPENNI2_FOLDER;  // of the build; in it OpenNI2 finds only that driver
const std::string kIni =
    "[live]\nsensors = xtion\nreopen_after_s = 0.6\n[xtion]\ndriver = COpenNI2Sensor\nsensorLabel = XTION\nwidth = "
    "640\nheight = 480\nfps = "
    "30\n"
    "grab_3D_points = false\nrelativePoseIntensityWRTDepth = [0 0 0 -90 0 -90]\n";

struct Recording {
  std::string name;  // of its folder
  std::string log;   // that the camera plays; empty: there is no camera
  double seconds = 30;
  int count = 1000;
  std::string words, unplugged, keys;
};

class XtionTest : public ::testing::Test {
 protected:
  // Two cameras are lost and come back while the other tests run, because most of this is waiting.
  static void SetUpTestSuite() {
    if (kOpenNi2.empty()) return;
    folder = std::make_unique<testing::ScratchFolder>();
    const std::string log = makeLog("flat", range_scans::flat(3));
    unplugged = std::make_unique<testing::Program>(command({"unplugged", log, 30, 1000, "is back", "0.7", ""}));
    silent = std::make_unique<testing::Program>(command({"silent", log, 30, 1000, "is back", "never", ""}));
  }
  static void TearDownTestSuite() {
    unplugged.reset();
    silent.reset();
    folder.reset();
  }
  void SetUp() override {
    if (kOpenNi2.empty()) GTEST_SKIP() << "this was built without OpenNI2 (Debian's libopenni2-dev)";
  }

  static std::string makeLog(const std::string& name, const range_scans::Scans& images) {
    const std::string path = *folder / name + ".rawlog";
    source::writeRawlog(path, [&](source::RawlogWriter& log) {
      for (const auto& scan : images) log.add(*scan);
    });
    return path;
  }

  static std::vector<std::string> command(const Recording& its) {
    std::ofstream(*folder / its.name + ".ini") << kIni << its.keys;
    std::vector<std::string> argv{"env", "LD_LIBRARY_PATH=" + kOpenNi2};
    if (!its.log.empty()) argv.push_back("OMNIMAPPER_PLAYED_LOG=" + its.log);
    if (!its.unplugged.empty()) argv.push_back("OMNIMAPPER_UNPLUGGED_S=" + its.unplugged);
    for (const auto& word : {testing::ownProgram("live-record"), *folder / its.name + ".ini", *folder / its.name,
                             std::to_string(its.seconds), std::to_string(its.count), its.words})
      argv.push_back(word);
    return argv;
  }

  // The number of the played image with these depths, in whole millimetres; none if there is none.
  std::optional<std::size_t> depthsOf(const range_scans::Scan& seen) const {
    for (std::size_t i = 0; i < played.size(); ++i) {
      const double unit = static_cast<double>(played[i]->rangeUnits), seen_unit = static_cast<double>(seen.rangeUnits);
      bool is_same = seen.rangeImage.size() == 640 * 480;
      for (int pixel = 0; pixel < 640 * 480 && is_same; ++pixel)
        is_same =
            std::abs(seen.rangeImage.data()[pixel] * seen_unit - played[i]->rangeImage.data()[pixel] * unit) < 0.000501;
      if (is_same) return i;
    }
    return std::nullopt;
  }

  static inline std::unique_ptr<testing::ScratchFolder> folder;
  static inline std::unique_ptr<testing::Program> unplugged, silent;
  range_scans::Scans played;
};

TEST_F(XtionTest, whatIsPlayedArrivesInMillimetres) {
  played = range_scans::simulated(6);
  ASSERT_EQ(played.size(), 6u);
  const auto ended = testing::runProgram(command({"out", makeLog("home", played), 20, 4, "is lost", "", ""}));
  EXPECT_EQ(ended.code, 0) << testing::toString(ended);
  const auto scans = range_scans::recorded<range_scans::Scan>(*folder / "out/log.rawlog");
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

// MRPT's driver alone would end the program.
TEST_F(XtionTest, aCameraThatIsNotThereIsAnError) {
  testing::Program without(command({"without", "", 5, 1000, "is lost", "", ""}));
  testing::Program with_one(
      command({"with_one", makeLog("one", range_scans::flat(1)), 5, 1000, "is lost", "", "device_number = 1\n"}));
  auto ended = without.wait();
  EXPECT_EQ(ended.code, static_cast<int>(base::ExitCode::unreadable_input)) << testing::toString(ended);
  EXPECT_NE(ended.err.find("[xtion] (COpenNI2Sensor) cannot be opened: OpenNI2 finds no camera"), std::string::npos)
      << testing::toString(ended);
  ended = with_one.wait();
  EXPECT_EQ(ended.code, static_cast<int>(base::ExitCode::unreadable_input)) << testing::toString(ended);
  EXPECT_NE(ended.err.find("there is no camera with device_number = 1"), std::string::npos) << testing::toString(ended);
}

void expectBack(const testing::Ended& ended, const std::string& loss) {
  EXPECT_NE(ended.out.find("sensor [xtion] is lost: " + loss), std::string::npos) << testing::toString(ended);
  EXPECT_NE(ended.out.find("sensor [xtion] is back"), std::string::npos) << testing::toString(ended);
  EXPECT_EQ(ended.code, 0) << "no driver is left running: " << testing::toString(ended);
}

TEST_F(XtionTest, anXtionThatIsUnpluggedIsReportedAndOpenedAgain) {
  expectBack(unplugged->wait(), "OpenNI2 reports that the camera is gone");
}

// MRPT's driver alone would wait for ever.
TEST_F(XtionTest, anXtionThatFallsSilentIsReportedAndOpenedAgain) {
  expectBack(silent->wait(), "it has sent nothing for");
}

}  // namespace
}  // namespace omnimapper::drivers::xtion_test
