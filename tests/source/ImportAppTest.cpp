#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "Logs.h"
#include "RgbdImages.h"

namespace omnimapper::source::import_app_test {
namespace {

using base::ExitCode;

// Runs omnimapper-import; output_ is its output.
class ImportApp : public ::testing::Test {
 protected:
  ExitCode run(const std::string& arguments) { return runCommand("'" OMNIMAPPER_IMPORT "' " + arguments); }
  ExitCode runCommand(const std::string& command) {
    FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    output_.clear();
    char buffer[4096];
    for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) output_.append(buffer, n);
    return static_cast<ExitCode>(WEXITSTATUS(::pclose(pipe)));
  }
  bool says(const std::string& text) const { return output_.find(text) != std::string::npos; }

  std::string output_;
};

class ImportAppTest : public ImportApp {
 protected:
  testing::ScratchFolder folder_;
  std::string in_ = folder_ / "x.clf", out_ = folder_ / "x.rawlog";
  const std::string log_ =
      "ODOM 1 0 0 0 0 0 10.4 h 0\nFLASER 3 1 2 3 1 0 0 1 0 0 10.5 h 0\nODOM 2 0 0 0 0 0 10.6 h 0\n";
};

TEST_F(ImportAppTest, writesARawlogAndSaysWhatIsInIt) {
  logs::writePlain(in_, log_);
  EXPECT_EQ(run("carmen " + in_ + " " + out_), ExitCode::ok) << output_;
  EXPECT_TRUE(says("FLASER") && says("ODOM") && says("10.500000") && says("complete")) << output_;
  RawlogSource source(out_);
  EXPECT_EQ(logs::readAll(source).size(), 4u) << "two of ODOM lines, a scan, its own odometry";
}

TEST_F(ImportAppTest, writtenRawlogIsReadByRawlogEdit) {
  logs::writePlain(in_, log_);
  ASSERT_EQ(run("carmen " + in_ + " " + out_), ExitCode::ok);
  if (std::system("command -v rawlog-edit >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "rawlog-edit (Debian package mrpt-apps) is not installed";
  EXPECT_EQ(runCommand("rawlog-edit --info -i '" + out_ + "'"), ExitCode::ok);
  EXPECT_TRUE(says("FLASER, FLASER_ODOM, ODOM")) << output_;
}

TEST_F(ImportAppTest, truncatedLogGivesWhatIsReadableAndExitCode9) {
  logs::writePlain(in_, log_ + "FLASER 3 1 2");
  EXPECT_EQ(run("carmen " + in_ + " " + out_), ExitCode::damaged_input);
  EXPECT_TRUE(says("line 4 left out")) << output_;
  RawlogSource source(out_);
  EXPECT_EQ(logs::readAll(source).size(), 4u) << "two of ODOM lines, a scan, its own odometry";
}

TEST_F(ImportAppTest, exitCodesShowWhatWentWrong) {
  EXPECT_EQ(run("--help"), ExitCode::ok);
  EXPECT_TRUE(says("Example: omnimapper-import carmen")) << output_;
  EXPECT_EQ(run(""), ExitCode::command_line);
  EXPECT_TRUE(says("the first argument is one of carmen, images, pcd, tum")) << output_;
  EXPECT_EQ(run("tmu a b"), ExitCode::command_line);
  EXPECT_TRUE(says("there is no task 'tmu'; did you mean tum?")) << output_;
  EXPECT_EQ(run("carmen " + in_), ExitCode::command_line);
  EXPECT_EQ(run("carmen a b --odometry wheels"), ExitCode::command_line);
  EXPECT_EQ(run("carmen " + in_ + " " + out_), ExitCode::unreadable_input);
  EXPECT_TRUE(says(in_ + ": No such file")) << output_;
  logs::writePlain(in_, log_);
  EXPECT_EQ(run("carmen " + in_ + " " + folder_.path() + "/no/x.rawlog"), ExitCode::unwritable_output);
}

TEST_F(ImportAppTest, inputOfAnotherTaskIsRefusedWithItsName) {
  logs::writePlain(in_, log_);
  EXPECT_EQ(run("tum " + in_ + " " + out_), ExitCode::unreadable_input);
  EXPECT_TRUE(says("is no folder: it is a CARMEN log")) << output_;
  EXPECT_EQ(run("carmen " + in_ + " " + out_), ExitCode::ok);
  EXPECT_EQ(run("carmen " + out_ + " " + in_), ExitCode::unreadable_input);
  EXPECT_TRUE(says("it is a rawlog, or")) << output_;
  EXPECT_EQ(run("pcd " + out_ + " " + in_), ExitCode::unreadable_input);
  EXPECT_TRUE(says("is no folder: it is a rawlog, or")) << output_;
}

TEST_F(ImportAppTest, aLogOfNothingLeavesWhatIsThere) {
  logs::writePlain(in_, "ODOM 1 2\nFLASER 3 1 2\n");
  logs::writePlain(out_, "an older log");
  EXPECT_EQ(run("carmen " + in_ + " " + out_), ExitCode::unreadable_input) << output_;
  EXPECT_TRUE(says(in_) && says("nothing was written")) << output_;
  EXPECT_EQ(std::filesystem::file_size(out_), 12U);
}

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

TEST_F(ImportAppTest, cloudsBecomeDepthImages) {
  // 8 x 6 pixels of a wall 2 m ahead, focal length 10, one point missing; and a file that is none.
  std::string text =
      "FIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 8\nHEIGHT 6\nPOINTS 48\nDATA ascii\n";
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 8; ++column) {
      const auto at = [](double pixel) { return std::to_string(2 * pixel / 10); };
      text += row == 2 && column == 3
                  ? "nan nan nan 0\n"
                  : at(column - 3.5) + " " + at(row - 2.5) + " 2 " + std::to_string(0x0A141E) + "\n";
    }
  }
  logs::writePlain(folder_ / "b.pcd", text);
  EXPECT_EQ(run("pcd '" + folder_.path() + "' '" + out_ + "' --rate 5 --label kinect"), ExitCode::ok) << output_;
  logs::writePlain(folder_ / "a.pcd", "none");
  EXPECT_EQ(run("pcd '" + folder_.path() + "' '" + out_ + "' --rate 5 --label kinect"), ExitCode::missing_images);
  EXPECT_TRUE(says("a.pcd")) << output_;
  RawlogSource source(out_);
  const auto all = logs::readAll(source);
  ASSERT_EQ(all.size(), 1U);
  const auto& scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan&>(*all[0]);
  EXPECT_EQ(scan.sensorLabel, "kinect");
  EXPECT_EQ(base::formatUnix(scan.timestamp, 1), "1000000000.2");
  EXPECT_NEAR(scan.cameraParams.fx(), 10, 1e-4);
  EXPECT_NEAR(scan.cameraParams.cy(), 2.5, 1e-4);
  EXPECT_EQ(scan.rangeImage(2, 3), 0);
  EXPECT_EQ(scan.rangeImage(5, 7), 20000);
  EXPECT_NEAR(scan.intensityImage.at<std::uint8_t>(0, 0, 2), 0x0A, 3) << "red, as JPEG";
  EXPECT_NEAR(scan.intensityImage.at<std::uint8_t>(0, 0, 0), 0x1E, 3);
}

TEST_F(ImportAppTest, cloudsThatNoCameraSawAreNamed) {
  logs::writePlain(folder_ / "odd.pcd",
                   "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 2\nDATA "
                   "ascii\n1 2 3\n4 5 6\n7 8 9\n1 1 1\n");
  EXPECT_EQ(run("pcd '" + folder_.path() + "' '" + out_ + "'"), ExitCode::unreadable_input);
  EXPECT_TRUE(says("odd.pcd: its points do not lie on the rays of a pinhole camera") && says("nothing was written"))
      << output_;
  EXPECT_FALSE(std::filesystem::exists(out_));
  EXPECT_EQ(run("pcd '" + folder_.path() + "/none' '" + out_ + "'"), ExitCode::unreadable_input);
}

}  // namespace
}  // namespace omnimapper::source::import_app_test
