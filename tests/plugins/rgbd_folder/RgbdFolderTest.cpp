#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/source/describeInput.h>
#include <omnimapper/source/openLogs.h>

#include "RgbdImages.h"
#include "rgbd_folder/RgbdFolder.h"

namespace omnimapper::source::rgbd_folder_test {
namespace {

using mrpt::obs::CObservation3DRangeScan;

class RgbdFolderTest : public ::testing::Test, protected RgbdImages {
 protected:
  std::string failure(const RgbdFolderOptions& options = {}) {
    try {
      RgbdFolder source(folder_.path(), options);
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      return error.what();
    }
    return "no failure";
  }
};

RgbdFolderOptions freiburg1() {
  RgbdFolderOptions options;
  options.intrinsics = "freiburg1";
  return options;
}

TEST_F(RgbdFolderTest, depthTakesTheColourImageOfItsTime) {
  writeTum();
  RgbdFolder source(folder_.path(), freiburg1());
  EXPECT_EQ(source.unpaired(), 1U);
  std::vector<CObservation3DRangeScan::Ptr> scans;
  while (auto observation = source.next())
    scans.push_back(std::dynamic_pointer_cast<CObservation3DRangeScan>(observation));
  ASSERT_EQ(scans.size(), 3U);
  EXPECT_EQ(base::formatUnix(scans[0]->timestamp, 2), "10.00");
  EXPECT_EQ(base::formatUnix(scans[2]->timestamp, 2), "10.20");
  EXPECT_FALSE(scans[1]->hasIntensityImage) << "its colour came too late";
  EXPECT_EQ(scans[1]->rangeImage(2, 3), 5023);
  EXPECT_EQ(*scans[2]->intensityImage(1, 1, 2), 'c') << "red is the last of MRPT's channels";
  EXPECT_EQ(scans[0]->rangeImage(2, 3), 5023);
  EXPECT_FLOAT_EQ(scans[0]->rangeUnits, 1 / 5000.0f);
  EXPECT_TRUE(scans[0]->range_is_depth);
  EXPECT_DOUBLE_EQ(scans[0]->cameraParams.fx(), 517.3);
  EXPECT_DOUBLE_EQ(scans[0]->cameraParamsIntensity.cy(), 255.3);
  EXPECT_EQ(source.report().ending, SourceReport::Ending::complete);

  RgbdFolderOptions wide = freiburg1();
  wide.largest_difference = 0.05;
  EXPECT_EQ(RgbdFolder(folder_.path(), wide).unpaired(), 0U);
}

TEST_F(RgbdFolderTest, truthIsOfTheBaseThatLooksAlongX) {
  writeTum();
  // The camera looks along the world's y: optical x along the world's x, y down.
  writeText("groundtruth.txt", "# truth\n10.0 1 2 3 -0.70710678 0 0 0.70710678\n");
  const RgbdFolder source(folder_.path(), freiburg1());
  const auto truth = source.truth();
  ASSERT_EQ(truth.size(), 1U);
  EXPECT_EQ(source.camera().dist[4], 1.1633) << "the lens as the benchmark calibrated it";
  const geometry::Se3& world_from_base = truth.front().second;
  const auto stamp = truth.front().first;
  EXPECT_FALSE(source.truthAt(stamp + base::durationFromSeconds(0.03)));
  ASSERT_TRUE(source.truthAt(stamp + base::durationFromSeconds(-0.015)));
  EXPECT_EQ(source.truthAt(stamp)->translation, world_from_base.translation);
  EXPECT_TRUE((world_from_base * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1, 3, 3), 1e-6)) << "ahead";
  EXPECT_TRUE((world_from_base * Eigen::Vector3d(0, 1, 0)).isApprox(Eigen::Vector3d(0, 2, 3), 1e-6)) << "left";
  EXPECT_TRUE((world_from_base * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(1, 2, 4), 1e-6)) << "up";
}

TEST_F(RgbdFolderTest, pairsOfEqualNamesAndSevenScenesAreForms) {
  writeDepth("depth/0001.png", 700);
  writeDepth("depth/0002.png", 700);
  writeColour("image/0001.png", 9);
  RgbdFolderOptions options;
  options.intrinsics = folder_ / "camera.yaml";
  writeText("camera.yaml",
            "%YAML:1.0\nCamera.fx: 500.5\nCamera.fy: 501\nCamera.cx: 1.5\nCamera.cy: 1\nCamera.k1: -0.1\n");
  RgbdFolder equal_names(folder_.path(), options);
  EXPECT_EQ(equal_names.pairs().size(), 2U);
  EXPECT_EQ(equal_names.unpaired(), 1U);
  EXPECT_EQ(equal_names.camera().distortion, mrpt::img::DistortionModel::plumb_bob);
  EXPECT_EQ(equal_names.camera().dist[0], -0.1);
  const auto scan = std::dynamic_pointer_cast<CObservation3DRangeScan>(equal_names.next());
  ASSERT_TRUE(scan);
  EXPECT_DOUBLE_EQ(scan->cameraParams.fx(), 500.5);
  EXPECT_FLOAT_EQ(scan->rangeUnits, 0.001f) << "as Open3D has ICL-NUIM";
  std::filesystem::rename(folder_ / "image", folder_ / "rgb");
  EXPECT_EQ(RgbdFolder(folder_.path(), options).depthUnits(), 1000);
  options.intrinsics = "icl_nuim";
  EXPECT_EQ(RgbdFolder(folder_.path(), options).depthUnits(), 5000) << "as ICL-NUIM has itself";

  std::filesystem::remove_all(folder_ / "depth");
  std::filesystem::remove_all(folder_ / "rgb");
  writeDepth("frame-000000.depth.png", 1000);
  writeColour("frame-000000.color.png", 9);
  writeText("frame-000000.pose.txt", "1 0 0 5\n0 1 0 6\n0 0 1 7\n0 0 0 1\n");
  RgbdFolder seven_scenes(folder_.path());
  EXPECT_EQ(seven_scenes.cameraName(), folder_ / "camera.yaml") << "that beside the images";
  ASSERT_EQ(seven_scenes.truth().size(), 1U);
  EXPECT_TRUE(seven_scenes.truth().front().second.translation.isApprox(Eigen::Vector3d(5, 6, 7)));
  const auto frame = std::dynamic_pointer_cast<CObservation3DRangeScan>(seven_scenes.next());
  ASSERT_TRUE(frame);
  EXPECT_FLOAT_EQ(frame->rangeUnits, 0.001f);
  std::filesystem::rename(folder_ / "frame-000000.color.png", folder_ / "frame-000000.color.jpg");
  EXPECT_EQ(RgbdFolder(folder_.path()).unpaired(), 0U) << "as some copies have it";
}

TEST_F(RgbdFolderTest, aListOfAssociationsGivesThePairsInItsOrder) {
  writeText("associations.txt", "# depth, colour\n0 depth/x.png 0 rgb/y.png\n1 depth/z.png 1 rgb/w.png\n");
  RgbdFolder numbered(folder_.path(), freiburg1());
  ASSERT_EQ(numbered.pairs().size(), 2U);
  EXPECT_EQ(numbered.pairs()[0].depth, folder_ / "depth/x.png");
  EXPECT_EQ(numbered.pairs()[1].colour, folder_ / "rgb/w.png");
  EXPECT_NEAR(base::secondsBetween(numbered.pairs()[0].stamp, numbered.pairs()[1].stamp), 1 / 30.0, 1e-6);
  writeText("associations.txt", "12.5 rgb/y.png 12.25 depth/x.png\n");
  RgbdFolder stamped(folder_.path(), freiburg1());
  EXPECT_EQ(base::formatUnix(stamped.pairs()[0].stamp, 2), "12.25") << "that of the depth image";
  EXPECT_EQ(stamped.pairs()[0].depth, folder_ / "depth/x.png");
  writeText("associations.txt", "0 depth/x.png\n");
  EXPECT_NE(failure(freiburg1()).find("line 1 is not of the form"), std::string::npos) << failure(freiburg1());
}

TEST_F(RgbdFolderTest, imagesNamedByNumbersComeInTheirOrder) {
  for (const char* number : {"10", "2", "0009", "0"}) {
    writeDepth(std::string("depth/") + number + ".png", 700);
    writeColour(std::string("rgb/") + number + ".png", 9);
  }
  const RgbdFolder source(folder_.path(), freiburg1());
  std::vector<std::string> names;
  for (const auto& pair : source.pairs()) names.push_back(std::filesystem::path(pair.depth).stem());
  EXPECT_EQ(names, (std::vector<std::string>{"0", "2", "0009", "10"}));
}

TEST_F(RgbdFolderTest, aCameraIsKnownByAWordOfTheFoldersName) {
  for (const std::string folder : {"vehicles", "iclr", "my_icl_room"}) {
    writeDepth(folder + "/depth/1.png", 700);
    writeColour(folder + "/image/1.png", 9);
  }
  EXPECT_EQ(RgbdFolder(folder_ / "my_icl_room").cameraName(), "icl_nuim");
  for (const std::string folder : {"chess/seq-01", "lab/seq-01"}) writeDepth(folder + "/frame-000000.depth.png", 700);
  EXPECT_EQ(RgbdFolder(folder_ / "chess/seq-01").cameraName(), "7_scenes");
  EXPECT_THROW(RgbdFolder(folder_ / "lab/seq-01"), base::Error) << "others name their images so, too";
  EXPECT_THROW(RgbdFolder(folder_ / "vehicles"), base::Error);
  EXPECT_THROW(RgbdFolder(folder_ / "iclr"), base::Error);
}

TEST_F(RgbdFolderTest, theMedianDepthIsOfAllPixelsThatHaveOne) {
  writeTum();
  for (const char* name : {"depth/a.png", "depth/b.png", "depth/c.png"}) writeDepth(name, 10000);
  RgbdFolder source(folder_.path(), freiburg1());
  EXPECT_EQ(source.cameraName(), "freiburg1");
  EXPECT_FALSE(source.medianDepth());
  while (source.next()) continue;
  // Three times the twelve values of 10000 + x + 10 y.
  EXPECT_DOUBLE_EQ(source.medianDepth().value(), 10011 / 5000.0);

  for (const char* name : {"depth/a.png", "depth/b.png", "depth/c.png"})
    writeDepth(name, 65535);  // wraps around to small values
  RgbdFolder wrapped(folder_.path(), freiburg1());
  while (wrapped.next()) continue;
  EXPECT_DOUBLE_EQ(wrapped.medianDepth().value(), 11 / 5000.0) << "65535 is no depth";
}

TEST_F(RgbdFolderTest, imagesThatCannotBeReadAreLeftOutAndCounted) {
  writeTum();
  std::filesystem::remove(folder_ / "rgb/a.png");
  writeText("depth/c.png", "no image");
  RgbdFolder source(folder_.path(), freiburg1());
  EXPECT_TRUE(source.next()) << "that without colour";
  EXPECT_FALSE(source.next());
  EXPECT_EQ(source.report().missing_images, 2U);
  EXPECT_EQ(source.report().first_missing_image, folder_ / "rgb/a.png");
  EXPECT_EQ(source.report().exitCode(), base::ExitCode::missing_images);
}

TEST_F(RgbdFolderTest, imagesOfAnotherSizeAreLeftOutAndCounted) {
  writeTum();
  for (const char* name : {"b", "d", "e"}) writeColour(std::string("rgb/") + name + ".png", 1);
  writeText("depth.txt", "10.0 depth/a.png\n10.1 depth/b.png\n10.2 depth/c.png\n10.3 depth/d.png\n");
  writeText("rgb.txt", "10.0 rgb/a.png\n10.1 rgb/b.png\n10.2 rgb/c.png\n10.3 rgb/d.png\n");
  writeDepth("depth/c.png", 5000, 40, 30);
  writeDepth("depth/d.png", 5000);
  SourceOptions options;
  options.openers[RgbdFolder::kName] = [](const std::string& path) {
    return std::make_unique<RgbdFolder>(path, freiburg1());
  };
  const auto source = openLogs({folder_.path()}, options);
  int taken = 0;
  while (source->next()) ++taken;
  EXPECT_EQ(taken, 3);
  EXPECT_EQ(source->report().unusableCount(), 1U);
  EXPECT_EQ(source->report().exitCode(), base::ExitCode::damaged_input);
}

TEST_F(RgbdFolderTest, itsFormsAreRecognizedAndSaid) {
  const auto isRecognized = [&](const std::string& folder) {
    return RgbdFolder::recognizes(LogLook::at(folder_ / folder));
  };
  writeText("tum/depth.txt", "");
  writeText("scenes/frame-000000.depth.png", "");
  writeText("equal/depth/1.png", "");
  writeText("equal/rgb/1.png", "");
  writeText("listed/associations.txt", "");
  for (const char* folder : {"tum", "scenes", "equal", "listed"}) {
    EXPECT_TRUE(isRecognized(folder)) << folder;
    EXPECT_NE(describeInput(folder_ / folder).find("is a folder of RGB-D images, which -r reads"), std::string::npos);
  }
  writeText("alone/depth/1.png", "");
  writeDepth("bare/1.png", 700);
  writeText("bare/intrinsics.K.txt", "");
  for (const char* folder : {"alone", "bare"}) EXPECT_TRUE(isRecognized(folder)) << folder;
  writeColour("bare/2.png", 9);
  EXPECT_FALSE(isRecognized("bare")) << "photographs are among them";
  EXPECT_NE(describeInput(folder_ / "bare").find("put its depth images into a folder depth/"), std::string::npos);
  writeText("parent/inner/depth.txt", "");
  EXPECT_FALSE(isRecognized("parent"));
  EXPECT_NE(describeInput(folder_ / "parent").find("in it, " + (folder_ / "parent/inner") + " is a folder of RGB-D"),
            std::string::npos);
}

TEST_F(RgbdFolderTest, foldersAsPeopleHaveThemTakeTheCameraBesideTheirImages) {
  for (const std::string pictures : {"color", "rgb", ""}) {
    const std::string folder = "of_" + pictures, depths = folder + (pictures == "rgb" ? "/depths/" : "/depth/");
    for (const std::string number : {"2", "10"}) {
      writeDepth(depths + number + ".png", 1500);
      if (!pictures.empty()) writeColour(folder + "/" + pictures + "/" + number + ".png", 9);
    }
    writeText(depths + "notes.txt", "no image");
    EXPECT_THROW(RgbdFolder(folder_ / folder), base::Error) << "no camera";
    writeText(folder + "/info.json", R"({"width": 4, "height": 3, "K": [5, 0, 1.5, 0, 6, 1.25, 0, 0, 1]})");
    RgbdFolder source(folder_ / folder);
    ASSERT_EQ(source.pairs().size(), 2U);
    EXPECT_EQ(source.unpaired(), pictures.empty() ? 2U : 0U);
    EXPECT_EQ(source.cameraName(), folder_ / (folder + "/info.json"));
    const auto scan = std::dynamic_pointer_cast<CObservation3DRangeScan>(source.next());
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->cameraParams.fy(), 6);
    EXPECT_FLOAT_EQ(scan->rangeImage(0, 0) * scan->rangeUnits, 1.5F);
    EXPECT_EQ(RgbdFolder(folder_ / depths).cameraName(), folder_ / (folder + "/info.json")) << "one folder above";
  }
}

TEST_F(RgbdFolderTest, imagesNamedByTimesArePairedByThem) {
  writeDepth("depth/1305031102.10.png", 700);
  writeDepth("depth/1305031102.15.png", 700);
  writeColour("rgb/1305031102.11.png", 9);
  const RgbdFolder source(folder_.path(), freiburg1());
  ASSERT_EQ(source.pairs().size(), 2U);
  EXPECT_EQ(base::formatUnix(source.pairs()[1].stamp, 2), "1305031102.15");
  EXPECT_EQ(source.pairs()[0].colour, folder_ / "rgb/1305031102.11.png");
  EXPECT_EQ(source.unpaired(), 1U);

  const auto relative = std::filesystem::relative(folder_.path()).string();
  RgbdFolder same(relative, freiburg1());
  EXPECT_EQ(same.pairs()[0].colour, relative + "/rgb/1305031102.11.png") << "the folder once";
  while (same.next()) continue;
  EXPECT_EQ(same.report().objects, 2U);
  EXPECT_EQ(same.report().missing_images, 0U);
}

TEST_F(RgbdFolderTest, aCameraOfImagesOfAnotherSizeIsRefused) {
  writeDepth("depth/1.png", 700);
  writeText("camera.json", R"({"width": 8, "height": 6, "K": [5, 0, 1.5, 0, 6, 1.25, 0, 0, 1]})");
  EXPECT_NE(failure().find("camera.json: is of images of 8 x 6 pixels, but "), std::string::npos) << failure();
  writeText("camera.json", R"({"K": [5, 0, 4.5, 0, 6, 1.25, 0, 0, 1]})");
  EXPECT_NE(failure().find("states a centre of 4.5, 1.2 pixels, but "), std::string::npos) << failure();
}

TEST_F(RgbdFolderTest, whatIsWrongIsSaidWithItsPlace) {
  EXPECT_NE(failure().find("is no folder of RGB-D images in a known form"), std::string::npos);
  writeTum();
  EXPECT_NE(failure().find("name the camera with --intrinsics"), std::string::npos) << failure();
  RgbdFolderOptions options;
  options.intrinsics = "freiburg7";
  EXPECT_NE(failure(options).find("freiburg7: is neither the name of a known camera"), std::string::npos);
  writeText("rgb.txt", "10.0 rgb/a.png\nten rgb/b.png\n");
  EXPECT_NE(failure(freiburg1()).find("rgb.txt: line 2 begins with 'ten'"), std::string::npos) << failure(freiburg1());
}

TEST(RgbdFolderRecording, freiburg1RpyIsWholeWithTruth) {
  const auto folder = testing::sharedData("rgbd/tum_fr1_rpy");
  OMNIMAPPER_NEEDS(folder);
  RgbdFolder source(*folder);
  EXPECT_EQ(source.pairs().size(), 450U);
  EXPECT_LT(source.unpaired(), 20U);
  EXPECT_GT(source.truth().size(), 1000U);
  const auto scan = std::dynamic_pointer_cast<CObservation3DRangeScan>(source.next());
  ASSERT_TRUE(scan);
  EXPECT_DOUBLE_EQ(scan->cameraParams.fx(), 517.3);
  EXPECT_EQ(scan->rangeImage.cols(), 640);
  int valid = 0, smooth = 0;
  for (int row = 0; row < 480; ++row) {
    for (int column = 1; column < 640; ++column) {
      const double here = scan->rangeImage(row, column) * scan->rangeUnits,
                   left = scan->rangeImage(row, column - 1) * scan->rangeUnits;
      if (here == 0 || left == 0) continue;
      EXPECT_GT(here, 0.3);
      EXPECT_LT(here, 12);
      ++valid;
      smooth += std::abs(here - left) < 0.05;
    }
  }
  EXPECT_GT(valid, 640 * 480 / 2);
  EXPECT_GT(smooth, 0.97 * valid) << "neighbours are of one surface";
}

TEST(RgbdFolderRecording, aLivingRoomIsAsLargeAsOne) {
  const auto folder = testing::sharedData("rgbd/icl_livingroom1");
  OMNIMAPPER_NEEDS(folder);
  RgbdFolder source(*folder);
  EXPECT_EQ(source.cameraName(), "icl_nuim");
  while (source.next()) continue;
  EXPECT_NEAR(source.medianDepth().value(), 1.75, 0.01);
}

TEST(RgbdFolderRecording, aCameraBesideTheImagesIsTaken) {
  const auto shelf = testing::sharedData("rgbd/apc_shelf25"), pointing = testing::sharedData("people/pointing");
  OMNIMAPPER_NEEDS(shelf && pointing);
  const RgbdFolder by_rows(*shelf);
  EXPECT_EQ(by_rows.pairs().size(), 25U);
  EXPECT_EQ(by_rows.truth().size(), 25U);
  EXPECT_EQ(by_rows.camera().fx(), 615.1951904296875) << "not that of 7-Scenes, whose names these images have";
  EXPECT_EQ(by_rows.camera().cy(), 247.51919555664062);
  RgbdFolder by_columns(*pointing);
  EXPECT_EQ(by_columns.pairs().size(), 38U);
  EXPECT_EQ(by_columns.unpaired(), 0U);
  EXPECT_EQ(by_columns.camera().cx(), 317.3921203613281);
  while (by_columns.next()) continue;
  EXPECT_NEAR(by_columns.medianDepth().value(), 2, 1) << "a man who sits at a table";
}

TEST(RgbdFolderRecording, keyFramesTakeTheStampsOfTheirPoses) {
  const auto folder = testing::sharedData("rgbd/tum_fr3_cabinet58");
  OMNIMAPPER_NEEDS(folder);
  const RgbdFolder source(*folder);
  ASSERT_EQ(source.pairs().size(), 58U);
  EXPECT_EQ(base::formatUnix(source.pairs().front().stamp, 4), "1341841278.8427");
}

}  // namespace
}  // namespace omnimapper::source::rgbd_folder_test
