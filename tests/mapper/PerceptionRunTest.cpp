#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/PerceptionRun.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace omnimapper::mapper::perception_run_test {
namespace {

using base::ExitCode;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation3DRangeScan;

/// A wall 2 m in front of a camera, with a colour image of it.
CObservation3DRangeScan::Ptr wallAt(double seconds) {
  auto scan = CObservation3DRangeScan::Create();
  scan->sensorLabel = "kinect";
  scan->timestamp = base::stampFromUnix(seconds);
  scan->hasRangeImage = scan->hasIntensityImage = true;
  scan->cameraParams.setIntrinsicParamsFromValues(100, 100, 79.5, 59.5);
  scan->cameraParams.ncols = 160;
  scan->cameraParams.nrows = 120;
  scan->cameraParamsIntensity = scan->cameraParams;
  scan->rangeImage_setSize(120, 160);
  scan->rangeImage.fill(2000);
  scan->intensityImage = mrpt::img::CImage(160, 120, mrpt::img::CH_RGB);
  scan->intensityImage.filledRectangle(0, 0, 159, 119, mrpt::img::TColor(200, 100, 50));
  return scan;
}

CObservation3DRangeScan::Ptr withoutPicture(CObservation3DRangeScan::Ptr scan) {
  scan->hasIntensityImage = false;
  return scan;
}

CObservation3DRangeScan::Ptr withoutFocalLength(CObservation3DRangeScan::Ptr scan) {
  scan->cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
  return scan;
}

class PerceptionRunTest : public ::testing::Test {
 protected:
  PerceptionRunTest() { mapper::loadFeatures(); }

  void writeRaw(const std::vector<CObservation::Ptr>& observations) {
    source::writeRawlog(raw_, [&](source::RawlogWriter& rawlog) {
      for (const auto& observation : observations) rawlog.add(*observation);
    });
  }
  PerceptionResult run(const std::vector<std::string>& logs, const std::string& output, bool with_raw = false,
                       const std::string& extractors = "planes") {
    auto config = base::Config::fromText(
        "[perception]\nextractors = " + extractors + "\n[planes]\n" + planes_ + "class = PlaneExtractor\n" +
            (extractors == "planes" ? "" : "[objects]\nclass = ObjectExtractor\nmax_tilt_deg = 180\n"),
        "test.ini");
    PerceptionRequest request;
    request.logs = logs;
    request.output = output;
    request.with_raw = with_raw;
    request.threads = 2;
    base::Progress silent;
    return runPerception(request, config, silent, [] { return false; });
  }
  static std::vector<std::string> labelsOf(const std::string& log) {
    std::vector<std::string> labels;
    source::RawlogSource source(log);
    while (const auto observation = source.next()) labels.push_back(observation->sensorLabel);
    return labels;
  }
  static std::string bytesOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  // The result has that code, and its only warning has all the words.
  static void expectWarning(const PerceptionResult& result, ExitCode code, const std::vector<std::string>& words) {
    EXPECT_EQ(result.code, code);
    ASSERT_EQ(result.warnings.size(), 1U);
    for (const auto& word : words)
      EXPECT_NE(result.warnings[0].find(word), std::string::npos) << word << ": " << result.warnings[0];
  }

  testing::ScratchFolder folder_;
  std::string planes_;  // INI lines of [planes]
  const std::string raw_ = folder_ / "raw.rawlog", derived_ = folder_ / "derived.rawlog";
};

TEST_F(PerceptionRunTest, AScanWithoutAPictureIsLeftOutAndSaid) {
  planes_ = "comparator = plane_colour\n";
  writeRaw({withoutPicture(wallAt(1)), wallAt(2), withoutPicture(wallAt(3)), wallAt(4)});
  const auto result = run({raw_}, derived_);
  expectWarning(result, ExitCode::damaged_input, {"2 observations", "kinect", "comparator = plane does without"});
  EXPECT_EQ(labelsOf(derived_), std::vector<std::string>(2, "kinect.planes"));
  EXPECT_EQ(result.extractors[0].taken, 2U);
  EXPECT_EQ(result.extractors[0].failed, 2U);
  EXPECT_NE(toText(result, "out").find("planes: 2 observations of 2, 2 left out"), std::string::npos);
}

TEST_F(PerceptionRunTest, AScanOfNoCalibrationIsLeftOutAndStaysInTheLog) {
  writeRaw({wallAt(1), withoutFocalLength(wallAt(2))});
  expectWarning(run({raw_}, derived_, true), ExitCode::damaged_input, {"1 observation", "kinect", "calibrate"});
  EXPECT_EQ(labelsOf(derived_), (std::vector<std::string>{"kinect", "kinect.planes", "kinect"}));
}

TEST_F(PerceptionRunTest, IfNoScanCanBeTakenThatIsTheErrorAndNothingIsWritten) {
  writeRaw({withoutFocalLength(wallAt(1)), withoutFocalLength(wallAt(2))});
  try {
    run({raw_}, derived_, true);
    FAIL() << "nothing was thrown";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unreadable_input);
    EXPECT_NE(std::string(error.what()).find("calibrate"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(derived_));
}

TEST_F(PerceptionRunTest, WhatTheLogBringsIsNotWrittenTwice) {
  writeRaw({wallAt(1), wallAt(2)});
  const std::string both = folder_ / "both.rawlog", again = folder_ / "again.rawlog";
  EXPECT_TRUE(run({raw_}, both, true).warnings.empty());
  ASSERT_EQ(labelsOf(both), (std::vector<std::string>{"kinect", "kinect.planes", "kinect", "kinect.planes"}));
  expectWarning(run({both}, again, true), ExitCode::ok, {"2 derived observations were in the log already"});
  EXPECT_TRUE(bytesOf(again) == bytesOf(both));
  EXPECT_TRUE(run({raw_}, derived_).warnings.empty());
  expectWarning(run({derived_, raw_}, again, true), ExitCode::ok, {"2 derived observations"});
  EXPECT_EQ(labelsOf(again).size(), 4U) << "whichever of the two comes first";
  EXPECT_TRUE(run({both}, again).warnings.empty()) << "what was derived before is not written without --with-raw";
  EXPECT_TRUE(bytesOf(again) == bytesOf(derived_));
}

TEST_F(PerceptionRunTest, OfTwoExtractorsWithOneLabelTheFirstCounts) {
  writeRaw({wallAt(1), wallAt(2)});
  planes_ = "min_pixels = 500\n";
  const auto result = run({raw_}, derived_, false, "planes, objects");
  expectWarning(result, ExitCode::ok, {"2 derived", "'kinect.planes' of [objects]", "[perception] extractors"});
  EXPECT_EQ(labelsOf(derived_),
            (std::vector<std::string>{"kinect.planes", "kinect.objects", "kinect.planes", "kinect.objects"}));
}

TEST_F(PerceptionRunTest, PlanesOfTheSameOptionsAreFoundOnce) {
  writeRaw({wallAt(1), wallAt(2)});
  const auto result = run({raw_}, derived_, false, "planes, objects");
  EXPECT_EQ(result.code, ExitCode::ok);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(labelsOf(derived_),
            (std::vector<std::string>{"kinect.planes", "kinect.objects", "kinect.planes", "kinect.objects"}));
}

TEST_F(PerceptionRunTest, AClockThatStandsStillLosesNothing) {
  std::vector<CObservation::Ptr> still;
  for (int i = 0; i < 150; ++i) {
    still.push_back(wallAt(1));
    still.back()->sensorLabel = "kinect_" + std::to_string(i);
  }
  writeRaw(still);
  EXPECT_EQ(run({raw_}, derived_, true).extractors[0].derived, 150U);
  EXPECT_EQ(labelsOf(derived_).size(), 300U);
}

}  // namespace
}  // namespace omnimapper::mapper::perception_run_test
