#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/ImportApp.h>
#include <omnimapper/testing/Logs.h>

#include <cstdlib>
#include <filesystem>

#include "RgbdImages.h"

namespace omnimapper::source::import_tum_test {
namespace {

using base::ExitCode;

/// A folder of two pairs and a depth image without a colour image of its time.
class ImportTumTest : public ImportApp, protected RgbdImages {
 protected:
  ImportTumTest() {
    writeTum();
    writeText("groundtruth.txt", "# truth\n10.0 1 2 3 0 0 0 1\n10.1 1 2 4 0 0 0 1\n");
  }
  ExitCode import(const std::string& more) { return run("tum '" + folder_.path() + "' '" + out_ + "' " + more); }
  std::vector<mrpt::obs::CObservation::Ptr> imported() {
    RawlogSource source(out_);
    auto all = logs::readAll(source);
    EXPECT_EQ(source.report().exitCode(), ExitCode::ok);
    return all;
  }

  testing::ScratchFolder result_;
  std::string out_ = result_ / "x.rawlog";
};

TEST_F(ImportTumTest, writesARawlogAndTheTruthBesideIt) {
  ASSERT_EQ(import("--intrinsics freiburg1 --label kinect"), ExitCode::ok) << output_;
  EXPECT_TRUE(says("without a colour image at their time, kept without colour: 1") && says("x.truth.tum, 2 poses"))
      << output_;
  const auto all = imported();
  ASSERT_EQ(all.size(), 3U);
  const auto& scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan&>(*all[2]);
  EXPECT_EQ(scan.sensorLabel, "kinect");
  EXPECT_EQ(base::formatUnix(scan.timestamp, 2), "10.20");
  EXPECT_EQ(scan.rangeImage(2, 3), 5023);
  EXPECT_EQ(scan.intensityImage.getWidth(), 4U);
  std::ifstream truth(result_ / "x.truth.tum");
  double stamp = 0, x = 0, y = 0, z = 0;
  ASSERT_TRUE(truth >> stamp >> x >> y >> z);
  EXPECT_EQ(stamp, 10);
  EXPECT_EQ(z, 3);
}

TEST_F(ImportTumTest, printsCameraAndDepthAndWarnsOfUnlikelyUnits) {
  ASSERT_EQ(import(""), ExitCode::unreadable_input) << output_;
  EXPECT_TRUE(says("does not show which camera took its images")) << output_;
  const std::string list = logs::readFile(folder_ / "depth.txt");
  std::ofstream(folder_ / "depth.txt") << "# depth maps\n# file: 'rgbd_dataset_freiburg1_rpy.bag'\n" << list;
  ASSERT_EQ(import(""), ExitCode::ok) << output_;
  EXPECT_TRUE(says("camera: freiburg1, fx 517.3 fy 516.5 cx 318.6 cy 255.3 pixels")) << output_;
  EXPECT_TRUE(says("depth: 5000 units per metre, median 1.00 m")) << output_;
  EXPECT_FALSE(says("warning")) << output_;
  ASSERT_EQ(import("--intrinsics freiburg1 --depth-units 1000"), ExitCode::ok) << output_;
  EXPECT_TRUE(says("warning: half of the depths are above 5.01 m: is depth_units_per_m = 1000 right?")) << output_;
  ASSERT_EQ(import("--intrinsics freiburg1 --depth-units 20000"), ExitCode::ok) << output_;
  EXPECT_TRUE(says("warning: half of the depths are below 0.25 m: is depth_units_per_m = 20000 right?")) << output_;
}

TEST_F(ImportTumTest, posesThatAreNotThereAreAnError) {
  EXPECT_EQ(import("--intrinsics freiburg1 --poses"), ExitCode::ok) << output_;
  EXPECT_TRUE(says("observations with a true pose in the rawlog: 2\n")) << output_;
  EXPECT_EQ(imported().size(), 5U);
  std::filesystem::remove(out_);
  writeText("groundtruth.txt", "20.0 1 2 3 0 0 0 1\n");
  EXPECT_EQ(import("--intrinsics freiburg1 --poses"), ExitCode::unreadable_input);
  EXPECT_TRUE(says("has no true pose at the time of any observation") && says("nothing was written")) << output_;
  std::filesystem::remove(folder_ / "groundtruth.txt");
  EXPECT_EQ(import("--intrinsics freiburg1 --poses"), ExitCode::unreadable_input);
  EXPECT_TRUE(says("has no ground truth for --poses") && says(folder_.path())) << output_;
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(ImportTumTest, withoutAnImageThatCanBeReadNothingIsWritten) {
  for (const char* images : {"depth", "rgb"}) std::filesystem::remove_all(folder_ / images);
  EXPECT_EQ(import("--intrinsics freiburg1 --images external"), ExitCode::unreadable_input) << output_;
  EXPECT_TRUE(says("nothing was written") && says("external file cannot be read: 3")) << output_;
  EXPECT_FALSE(says(" 0 bytes")) << output_;
  EXPECT_TRUE(std::filesystem::is_empty(result_.path()));
}

TEST_F(ImportTumTest, aListThatIsMissingIsNamed) {
  std::filesystem::remove(folder_ / "depth.txt");
  EXPECT_EQ(import("--intrinsics freiburg1"), ExitCode::unreadable_input);
  EXPECT_TRUE(says(folder_.path()) && says("no depth.txt")) << output_;
  std::filesystem::remove(folder_ / "rgb.txt");
  for (const std::string name : {"a", "b", "c"})  // TUM's names are stamps, of which no two are equal
    std::filesystem::rename(folder_ / ("rgb/" + name + ".png"), folder_ / ("rgb/0" + name + ".png"));
  EXPECT_EQ(import("--intrinsics freiburg1"), ExitCode::unreadable_input);
  EXPECT_TRUE(says("depth.txt and rgb.txt") && says("are they missing?")) << output_;
}

TEST_F(ImportTumTest, helpShowsTheDefaults) {
  EXPECT_EQ(run("tum --help"), ExitCode::ok);
  for (const char* value : {"0.02", "30", "RGBD", "embedded"}) EXPECT_TRUE(says(value)) << value << ": " << output_;
}

TEST_F(ImportTumTest, aLabelNamesNoFileElsewhere) {
  ASSERT_EQ(import("--intrinsics freiburg1 --images external --tolerance 0.05 --label ../../x"), ExitCode::ok)
      << output_;
  const auto outside = std::filesystem::path(result_.path()).parent_path();
  for (const auto& entry : std::filesystem::directory_iterator(outside))
    EXPECT_NE(entry.path().filename().string().rfind("x_", 0), 0U) << entry.path();
  EXPECT_EQ(imported().size(), 3U);
}

TEST_F(ImportTumTest, imagesMayStayOutsideTheRawlog) {
  ASSERT_EQ(import("--intrinsics freiburg1 --images external --tolerance 0.05"), ExitCode::ok) << output_;
  const auto all = imported();
  ASSERT_EQ(all.size(), 3U);
  const auto& scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan&>(*all[0]);
  EXPECT_TRUE(scan.rangeImage_isExternallyStored() && scan.intensityImage.isExternallyStored());
  EXPECT_EQ(scan.rangeImage(2, 3), 5023);
  const std::filesystem::path images(result_ / "x_Images");
  for (const auto& file : std::filesystem::directory_iterator(images)) {
    if (file.path().string().find("_range") == std::string::npos) continue;
    std::filesystem::remove(file.path());
    break;
  }
  RawlogSource source(out_);
  EXPECT_EQ(logs::readAll(source).size(), 2U);
  EXPECT_EQ(source.report().exitCode(), ExitCode::missing_images);
}

TEST_F(ImportTumTest, whatIsWrongIsSaid) {
  EXPECT_EQ(import(""), ExitCode::unreadable_input);
  EXPECT_TRUE(says("name the camera with --intrinsics")) << output_;
  EXPECT_EQ(import("--tolerance -1"), ExitCode::command_line);
  EXPECT_EQ(import("--images elsewhere"), ExitCode::command_line);
  EXPECT_EQ(run("tum '" + folder_.path() + "/rgb' '" + out_ + "'"), ExitCode::unreadable_input);
  EXPECT_TRUE(says("is no folder of RGB-D images in a known form")) << output_;
  std::filesystem::remove(folder_ / "depth/a.png");
  EXPECT_EQ(import("--intrinsics freiburg1"), ExitCode::missing_images);
  EXPECT_EQ(imported().size(), 2U) << "what was there";
}

}  // namespace
}  // namespace omnimapper::source::import_tum_test
