#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <fstream>

#include "rgbd_folder/CameraFile.h"

namespace omnimapper::source::camera_file_test {
namespace {

using mrpt::img::DistortionModel;

class CameraFileTest : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  // fx, fy, cx, cy.
  std::vector<double> read(const std::string& text, const std::string& name = "camera.txt") {
    const auto file = readCameraFile(write(name, text));
    if (!file) return {};
    last_ = *file;
    return {file->camera.fx(), file->camera.fy(), file->camera.cx(), file->camera.cy()};
  }
  template <class Read>
  static std::string failure(Read read) {
    try {
      read();
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      return error.what();
    }
    return "no failure";
  }

  const std::vector<double> values_{600, 601, 320.5, 240.25};
  CameraFile last_;
  testing::ScratchFolder folder_;
};

TEST_F(CameraFileTest, aMatrixIsReadByRows) {
  EXPECT_EQ(read("600 0 320.5\n0 601 240.25\n0 0 1\n"), values_);
  EXPECT_EQ(read("# K\n600, 0, 320.5, 0, 601, 240.25, 0, 0, 1"), values_);
  EXPECT_EQ(read("600 0 320.5 0\n0 601 240.25 0\n0 0 1 0\n0 0 0 1\n"), values_) << "as ScanNet has it";
  EXPECT_EQ(read("600 601 320.5 240.25"), values_);
  EXPECT_EQ(last_.camera.ncols, 0U);
  EXPECT_EQ(last_.camera.distortion, DistortionModel::none);
}

TEST_F(CameraFileTest, open3dHasItsMatrixByColumns) {
  EXPECT_EQ(read(R"({"width" : 640, "height" : 480,
                     "intrinsic_matrix" : [ 600, 0, 0, 0, 601, 0, 320.5, 240.25, 1 ] })"),
            values_);
  EXPECT_EQ(last_.camera.ncols, 640U);
  EXPECT_EQ(last_.camera.nrows, 480U);
}

TEST_F(CameraFileTest, cameraInfoOfRosIsReadAsYamlAndAsJson) {
  EXPECT_EQ(read("image_width: 640\nimage_height: 480\ncamera_name: kinect\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
                 "  data: [600, 0., 320.5, 0., 601, 240.25, 0., 0., 1.]\ndistortion_model: plumb_bob\n"
                 "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0.1, -0.2, 0.001, 0.002, 0]\n"
                 "projection_matrix:\n  rows: 3\n  cols: 4\n  data: [590, 0, 321, 0, 0, 591, 241, 0, 0, 0, 1, 0]\n"),
            values_);
  EXPECT_EQ(last_.camera.ncols, 640U);
  EXPECT_EQ(last_.camera.distortion, DistortionModel::plumb_bob);
  EXPECT_EQ(last_.camera.dist[1], -0.2);
  EXPECT_EQ(read(R"({"header": {"frame_id": "optical"}, "height": 480, "width": 640, "distortion_model": "plumb_bob",
                     "D": [0, 0, 0, 0, 0], "K": [600, 0, 320.5, 0, 601, 240.25, 0, 0, 1],
                     "R": [1, 0, 0, 0, 1, 0, 0, 0, 1]})"),
            values_);
  EXPECT_EQ(last_.camera.distortion, DistortionModel::none);
  EXPECT_EQ(
      read("height: 480\nwidth: 640\ndistortion_model: rational_polynomial\nd:\n- 0.5\n- 0.0\n- 0.0\n- 0.0\n- "
           "0.0\n- 0.25\nk:\n- 600.0\n- 0.0\n- 320.5\n- 0.0\n- 601.0\n- 240.25\n- 0.0\n- 0.0\n- 1.0\nr:\n- 1.0\n"),
      values_)
      << "as ros2 topic echo prints it";
  EXPECT_EQ(last_.camera.dist[0], 0.5);
  EXPECT_EQ(last_.camera.dist[5], 0.25);
}

TEST_F(CameraFileTest, namedNumbersAreReadWithOrbSlamsUnits) {
  EXPECT_EQ(read("%YAML:1.0\nCamera.fx: 600\nCamera.fy: 601\nCamera.cx: 320.5\nCamera.cy: 240.25\nCamera.k1: 0.0\n"
                 "DepthMapFactor: 5000.0\n"),
            values_);
  EXPECT_EQ(last_.depth_units_per_m, 5000);
  EXPECT_EQ(read(R"({"fx": 600, "fy": 601, "ppx": 320.5, "ppy": 240.25})"), values_) << "as librealsense has it";
}

TEST_F(CameraFileTest, otherTextsStateNoCamera) {
  EXPECT_EQ(read("1 2 3\n"), std::vector<double>());
  EXPECT_EQ(read("10.0 1 2 3 0 0 0 1\n10.1 1 2 3 0 0 0 1\n"), std::vector<double>()) << "poses";
  EXPECT_EQ(read("k: 5\nname: robot\n"), std::vector<double>());
}

TEST_F(CameraFileTest, whatCannotBeUsedIsSaid) {
  EXPECT_NE(failure([&] {
              read("fx: 1\nfy: 1\ncx: 1\ncy: 1\n---\nfx: 2\nfy: 1\ncx: 1\ncy: 1\n");
            }).find("states several cameras: 'fx'"),
            std::string::npos);
  EXPECT_NE(failure([&] { read("1 2 3 4 5 6 7 8 9"); }).find("no matrix of a camera"), std::string::npos);
  EXPECT_NE(failure([&] { read("fx: 1\nfy: 1\ncx: 1\ncy: 1\nk1: nan\n"); }).find("are not finite"), std::string::npos);
  EXPECT_NE(failure([&] { read("481.2 -480 319.5 239.5"); }).find("states a negative fy"), std::string::npos)
      << "as ICL-NUIM does";
  EXPECT_NE(failure([&] { read("0 0 320 240"); }).find("states no focal length"), std::string::npos);
  EXPECT_NE(failure([&] {
              read("distortion_model: equidistant\nd: [0.1, 0, 0, 0]\nk: [600, 0, 320, 0, 600, 240, 0, 0, 1]\n");
            }).find("a lens 'equidistant' with 4 coefficients, which is not read"),
            std::string::npos);
}

TEST_F(CameraFileTest, ofSeveralFilesAllStateTheSameCamera) {
  write("groundtruth.txt", "600 601 320.5 240.25\n");
  EXPECT_FALSE(cameraFileIn({folder_.path()})) << "its name does not say that it is one";
  write("intrinsics.K.txt", "600 0 320.5\n0 601 240.25\n0 0 1\n");
  write("other.json", R"({"frames": 10})");
  EXPECT_EQ(cameraFileIn({folder_.path()}).value().path, folder_ / "intrinsics.K.txt");
  write("info.json", R"({"K": [600, 0, 320.5, 0, 601, 240.25, 0, 0, 1]})");
  EXPECT_EQ(cameraFileIn({folder_.path()}).value().path, folder_ / "info.json");
  write("info.json", R"({"K": [700, 0, 320.5, 0, 601, 240.25, 0, 0, 1]})");
  EXPECT_NE(failure([&] { cameraFileIn({folder_.path()}); }).find("states another camera than"), std::string::npos);
}

}  // namespace
}  // namespace omnimapper::source::camera_file_test
