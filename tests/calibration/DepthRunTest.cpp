#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/calibration/DepthRun.h>
#include <omnimapper/camera/CameraCalibration.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/source/openLogs.h>
#include <omnimapper/testing/ChildProgram.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "DistortedDepths.h"

namespace omnimapper::calibration::depth_run_test {
namespace {

using camera::DepthDistortion;
using mrpt::obs::CObservation3DRangeScan;

constexpr int kImages = 24;

/// Root mean square over the image [1/m].
double rmsOf(const std::function<double(double x, double y)>& value) {
  double squares = 0;
  constexpr int kSide = 20;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column)
      squares += std::pow(value((2.0 * column + 1) / kSide - 1, (2.0 * row + 1) / kSide - 1), 2) / (kSide * kSide);
  }
  return std::sqrt(squares);
}

double rmsBetween(const DepthDistortion& a, const DepthDistortion& b) {
  return rmsOf([&](double x, double y) { return a.at(x, y) - b.at(x, y); });
}

double rmsOf(const DepthDistortion& distortion) {
  return rmsBetween(distortion, {});
}

class DepthRunTest : public ::testing::Test {
 protected:
  void write(const DistortedDepths& depths, int images = kImages,
             const std::function<void(int, CObservation3DRangeScan&)>& change = {}) {
    source::writeRawlog(request_.logs.front(), [&](source::RawlogWriter& rawlog) {
      for (int i = 0; i < images; ++i) {
        auto scan = depths.imageOf(i);
        if (change) change(i, scan);
        rawlog.add(scan);
      }
    });
  }
  CalibrationResult run() {
    base::Progress progress;
    return runDepthCalibration(request_, progress, [] { return false; });
  }
  std::string refusal() {
    try {
      run();
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::nothing_to_map);
      EXPECT_FALSE(std::filesystem::exists(request_.output + "/calibration.ini"));
      return error.what();
    }
    ADD_FAILURE() << "it was not refused";
    return "";
  }
  DepthDistortion written() const {
    return camera::CameraCalibration::read(base::Config::fromFile(request_.output + "/calibration.ini"))
        .depthDistortion();
  }
  std::string read(const std::string& name) const {
    std::ifstream in(request_.output + "/" + name);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }

  testing::ScratchFolder folder_;
  DepthRequest request_{{folder_ / "camera.rawlog"}, "", folder_ / "out", ""};
};

/// Error of the distortion that was found, in its standard deviations; root mean square over the image.
double deviationsOf(const DepthDistortion& found, const nlohmann::json& summary, const DepthDistortion& truth) {
  const auto sigmas = summary["sigma_by_part_per_m"].get<std::vector<double>>();
  double squares = 0;
  for (std::size_t i = 0; i < sigmas.size(); ++i) {
    const double x = (2.0 * (i % 8) + 1) / 8 - 1, y = (2.0 * (i / 8) + 1) / 6 - 1;  // NOLINT
    squares += std::pow((found.at(x, y) - truth.at(x, y)) / sigmas[i], 2);
  }
  return std::sqrt(squares / static_cast<double>(sigmas.size()));
}

TEST_F(DepthRunTest, FindsAKnownDistortionWithinItsStandardDeviation) {
  DistortedDepths depths;
  depths.distortion = kinectDistortion();
  write(depths);
  const auto result = run();
  EXPECT_EQ(result.code, base::ExitCode::ok);
  EXPECT_TRUE(result.is_better);
  EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
  EXPECT_LT(rmsBetween(written(), depths.distortion), 0.1 * rmsOf(depths.distortion)) << result.text;
  EXPECT_NE(read("calibration.ini").find("label = camera\n"), std::string::npos);
  const auto json = nlohmann::json::parse(read("summary.json"));
  const double deviations = deviationsOf(written(), json, depths.distortion);
  EXPECT_LT(deviations, 2) << result.text;
  EXPECT_GT(deviations, 0.3) << result.text;
  EXPECT_EQ(json["degree"], 4);
  EXPECT_EQ(json["images_held_back"], kImages / 3);
  EXPECT_LT(json["held_back_after_rms_per_m"], 0.8 * json["held_back_before_rms_per_m"].get<double>());
  EXPECT_EQ(read("report.txt"), result.text);
  EXPECT_NE(result.text.find("neither its constant nor its slope"), std::string::npos);
  EXPECT_NE(read("distortion.svg").find("</svg>"), std::string::npos);

  const auto once = read("calibration.ini") + read("summary.json") + read("distortion.svg");
  run();
  EXPECT_EQ(read("calibration.ini") + read("summary.json") + read("distortion.svg"), once) << "bytes of two runs";
}

// If the error has a constant and a slope, too, only the rest is found, because planes stay flat with these.
TEST_F(DepthRunTest, AConstantAndASlopeChangeNothing) {
  DistortedDepths depths;
  depths.distortion = kinectDistortion();
  write(depths, kImages, [](int, CObservation3DRangeScan& scan) {
    for (int v = 0; v < static_cast<int>(scan.rangeImage.rows()); ++v) {
      for (int u = 0; u < static_cast<int>(scan.rangeImage.cols()); ++u) {
        auto& range = scan.rangeImage(v, u);
        if (range > 0) range = static_cast<std::uint16_t>(std::lround(1 / (1.0 / range + 5e-6 + 2e-8 * u)));
      }
    }
  });
  run();
  EXPECT_LT(rmsBetween(written(), depths.distortion), 0.1 * rmsOf(depths.distortion));
}

TEST_F(DepthRunTest, NoiseAloneIsNothingToMend) {
  write({});
  const auto message = refusal();
  EXPECT_NE(message.find("get no flatter"), std::string::npos) << message;
  EXPECT_NE(message.find("record walls"), std::string::npos) << message;
}

TEST_F(DepthRunTest, OneWallFromAfarThatFillsAPartIsRefused) {
  DistortedDepths depths;
  depths.distortion = kinectDistortion();
  depths.has_floor = false;
  depths.nearest = 4;
  depths.farthest = 5;
  depths.share = 0.4;
  write(depths);
  const auto message = refusal();
  EXPECT_NE(message.find("% of the image"), std::string::npos) << message;
  EXPECT_NE(message.find("come so near"), std::string::npos) << message;
}

TEST_F(DepthRunTest, OneWallFromOneDistanceLeavesAWarning) {
  DistortedDepths depths;
  depths.distortion = kinectDistortion();
  depths.has_floor = false;
  depths.nearest = 2;
  depths.farthest = 2.1;
  depths.turn = 0.05;
  write(depths);
  const auto result = run();
  EXPECT_LT(rmsBetween(written(), depths.distortion), 0.15 * rmsOf(depths.distortion));
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings.front().find("near and far"), std::string::npos) << result.warnings.front();
}

TEST_F(DepthRunTest, ACameraAtRestAndTooFewImagesAreRefused) {
  DistortedDepths depths;
  depths.distortion = kinectDistortion();
  write(depths, 8);
  EXPECT_NE(refusal().find("8 different depth images of 12"), std::string::npos);
  const auto first = depths.imageOf(0);
  write(depths, 20, [&](int, CObservation3DRangeScan& scan) { scan.rangeImage = first.rangeImage; });
  EXPECT_NE(refusal().find("1 different depth image of 12"), std::string::npos);
}

TEST_F(DepthRunTest, ALogWithoutDepthsIsRefused) {
  write({}, 3, [](int, CObservation3DRangeScan& scan) { scan.hasRangeImage = false; });
  EXPECT_NE(refusal().find("no depth images"), std::string::npos);
  write({}, 3, [](int, CObservation3DRangeScan& scan) { scan.rangeImage.fill(0); });
  EXPECT_NE(refusal().find("1 different depth image of 12"), std::string::npos);
  write({}, 3, [](int, CObservation3DRangeScan& scan) { scan.cameraParams.fx(std::nan("")); });
  const auto message = refusal();
  EXPECT_NE(message.find("there is no observation"), std::string::npos) << message;
  request_.label = "front";
  EXPECT_NE(refusal().find("'front'"), std::string::npos);
}

TEST_F(DepthRunTest, ImagesWhoseUnitIsNoLengthAreRefused) {
  for (const float unit : {std::numeric_limits<float>::quiet_NaN(), 0.F, -0.001F}) {
    write({}, kImages, [&](int, CObservation3DRangeScan& scan) { scan.rangeUnits = unit; });
    EXPECT_NE(refusal().find("'camera'"), std::string::npos) << unit;
  }
}

TEST_F(DepthRunTest, TheReadablePartOfADamagedLogIsUsedAndReported) {
  DistortedDepths depths;
  depths.distortion = kinectDistortion();
  write(depths, 40);
  const auto log = request_.logs.front();
  const auto size = std::filesystem::file_size(log);
  std::filesystem::resize_file(log, size / 10 * 6);
  const auto result = run();
  EXPECT_EQ(result.code, base::ExitCode::damaged_input);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_NE(result.warnings.front().find("camera.rawlog"), std::string::npos) << result.warnings.front();
  std::filesystem::remove_all(request_.output);
  std::filesystem::resize_file(log, size / 10);
  EXPECT_NE(refusal().find("of 12 that are needed"), std::string::npos);
  std::ofstream(log) << "This is no log.";
  try {
    run();
    ADD_FAILURE() << "it was taken";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unreadable_input) << error.what();
    EXPECT_NE(std::string(error.what()).find("camera.rawlog"), std::string::npos) << error.what();
  }
}

TEST_F(DepthRunTest, PlacesWithoutDepthChangeLittleAndOtherSizesAreCounted) {
  DistortedDepths depths;
  depths.distortion = kinectDistortion();
  DistortedDepths small;
  small.width = 80;
  small.height = 60;
  write(depths, kImages, [&](int i, CObservation3DRangeScan& scan) {
    if (i == 5 || i == 6) scan = small.imageOf(i);
    if (i == 5 || i == 6) return;
    // A hole, a saturated hole, and single pixels without depth.
    for (int v = 20; v < 60; ++v)
      for (int u = 30; u < 60; ++u) scan.rangeImage(v, u) = v < 40 ? 0 : 65535;
    for (int k = i; k < 19200; k += 37) scan.rangeImage(k / 160, k % 160) = 0;
  });
  const auto result = run();
  EXPECT_LT(rmsBetween(written(), depths.distortion), 0.15 * rmsOf(depths.distortion)) << result.text;
  ASSERT_FALSE(result.warnings.empty()) << result.text;
  EXPECT_NE(result.warnings.front().find("2 observations of 'camera' were left out because their size"),
            std::string::npos)
      << result.warnings.front();
}

TEST_F(DepthRunTest, TheDistortionIsAddedToThatOfTheGivenIni) {
  DistortedDepths depths;
  depths.distortion = kinectDistortion();
  write(depths);
  request_.ini = folder_ / "before.ini";
  std::ofstream(request_.ini) << "[calibration]\ndepth_fx_px = 130\ndepth_scale = 1.05\n"
                                 "depth_distortion_per_m = -0.002, 0.001, 0.0005\n";
  run();
  EXPECT_LT(rmsBetween(written(), depths.distortion), 0.1 * rmsOf(depths.distortion)) << read("calibration.ini");
  const auto ini = read("calibration.ini");
  EXPECT_NE(ini.find("depth_fx_px = 130\n"), std::string::npos) << ini;
  EXPECT_NE(ini.find("depth_scale = 1.05\n"), std::string::npos) << ini;
  // After the written calibration is applied, no distortion is left to find.
  std::filesystem::rename(request_.output, folder_ / "first");
  request_.ini = folder_ / "first/calibration.ini";
  EXPECT_NE(refusal().find("get no flatter"), std::string::npos);
}

TEST_F(DepthRunTest, TheFolderOfAMapIsNotTaken) {
  std::filesystem::create_directories(request_.output);
  std::ofstream(request_.output + "/map.omnimap") << "a map";
  try {
    run();
    ADD_FAILURE() << "it was taken";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unwritable_output);
  }
}

/// Mean number of planes that omnimapper-perceive finds in an image.
double planesPerImage(const std::vector<std::string>& inis, const std::string& log, const std::string& output) {
  std::vector<std::string> command{testing::ownProgram("omnimapper-perceive"), "-q", "-r", log, "-o", output};
  for (const auto& ini : inis) command.insert(command.end(), {"-i", ini});
  const auto ended = testing::runProgram(command);
  EXPECT_EQ(ended.code, 0) << testing::toString(ended);
  source::RawlogSource derived(output);
  double planes = 0, images = 0;
  while (const auto observation = derived.next()) {
    const auto found = std::dynamic_pointer_cast<obs::CObservationPlanes>(observation);
    if (!found) continue;
    planes += static_cast<double>(found->planes.size());
    ++images;
  }
  return planes / images;
}

// Walls that are split into several planes by the sensor's distortion become one plane again.
TEST_F(DepthRunTest, TheProgramsFindAndApplyIt) {
  DistortedDepths depths;
  depths.has_floor = false;
  depths.sigma = 0.001;
  depths.width = 240;
  depths.height = 180;
  depths.distortion = DepthDistortion({-0.012, 0.006, 0.009});
  write(depths, 24);
  const auto calibrate = testing::ownProgram("omnimapper-calibrate");
  const auto ended =
      testing::runProgram({calibrate, "depth", "-r", request_.logs.front(), "-o", request_.output, "--degree", "2"});
  ASSERT_EQ(ended.code, 0) << testing::toString(ended);
  EXPECT_NE(ended.out.find("next: omnimapper-graphslam"), std::string::npos) << ended.out;
  const auto planes = folder_ / "planes.ini";
  std::ofstream(planes) << "[perception]\nextractors = planes\n[planes]\nclass = PlaneExtractor\n";
  const auto derived = folder_ / "derived.rawlog", ini = request_.output + "/calibration.ini";
  EXPECT_GT(planesPerImage({planes}, request_.logs.front(), derived), 2);
  EXPECT_LT(planesPerImage({planes, ini}, request_.logs.front(), derived), 1.2);

  const auto few =
      testing::runProgram({calibrate, "depth", "-r", request_.logs.front(), "-o", folder_ / "few", "--end", "0.5"});
  EXPECT_EQ(few.code, 14) << testing::toString(few);
  EXPECT_NE(few.err.find("camera.rawlog"), std::string::npos) << few.err;
  const auto help = testing::runProgram({calibrate, "depth", "--help"});
  EXPECT_NE(help.out.find("--degree"), std::string::npos) << help.out;
}

/// Writes every `every`-th depth image of a folder of the TUM RGB-D benchmark to a log.
void importDepths(const std::string& folder, int every, const std::string& output) {
  const auto images = source::openLogs({folder}, {});
  source::writeRawlog(output, [&](source::RawlogWriter& rawlog) {
    for (int i = 0; const auto image = images->next(); ++i) {
      auto scan = std::dynamic_pointer_cast<CObservation3DRangeScan>(image);
      if (!scan || i % every != 0) continue;
      scan->hasIntensityImage = false;
      rawlog.add(*scan);
    }
  });
}

TEST_F(DepthRunTest, OfARealXtionPlanesGetAQuarterFlatter) {
  const auto folder = testing::sharedData("rgbd/tum_fr3_cabinet58");
  OMNIMAPPER_NEEDS(folder);
  OMNIMAPPER_NEEDS_FORMAT("rgbd_folder");
  importDepths(*folder, 1, request_.logs.front());
  const auto result = run();
  const auto json = nlohmann::json::parse(read("summary.json"));
  EXPECT_LT(json["held_back_after_rms_per_m"], 0.75 * json["held_back_before_rms_per_m"].get<double>()) << result.text;
  // The halves of the log show the cabinet from two sides.
  EXPECT_LT(json["halves_differ_rms_per_m"], 0.25 * json["rms_per_m"].get<double>()) << result.text;
}

TEST_F(DepthRunTest, OfARealKinectPlanesGetFlatter) {
  const auto folder = testing::sharedData("rgbd/tum_fr1_rpy");
  OMNIMAPPER_NEEDS(folder);
  OMNIMAPPER_NEEDS_FORMAT("rgbd_folder");
  importDepths(*folder, 5, request_.logs.front());
  const auto result = run();
  const auto json = nlohmann::json::parse(read("summary.json"));
  EXPECT_LT(json["held_back_after_rms_per_m"], 0.95 * json["held_back_before_rms_per_m"].get<double>()) << result.text;
}

}  // namespace
}  // namespace omnimapper::calibration::depth_run_test
