#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/ImportApp.h>
#include <omnimapper/testing/Logs.h>

#include <cstdlib>
#include <filesystem>

namespace omnimapper::source::import_pcd_test {
namespace {

using base::ExitCode;

class ImportPcdTest : public ImportApp {
 protected:
  testing::ScratchFolder folder_, result_;
  std::string out_ = result_ / "x.rawlog";
};

TEST_F(ImportPcdTest, cloudsBecomeDepthImages) {
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

TEST_F(ImportPcdTest, cloudsThatNoCameraSawAreNamed) {
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
}  // namespace omnimapper::source::import_pcd_test
