#include <mrpt/img/CImage.h>
#include <mrpt/io/lazy_load_path.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/Logs.h>

#include <filesystem>

namespace omnimapper::source::external_images_test {
namespace {

using namespace logs;
namespace fs = std::filesystem;

class ExternalImagesTest : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(images_); }

  void saveImage(const std::string& name, int red) {
    mrpt::img::CImage image(8, 6, mrpt::img::CH_RGB);
    image.filledRectangle(0, 0, 7, 5, mrpt::img::TColor(static_cast<std::uint8_t>(red), 0, 0));
    ASSERT_TRUE(image.saveToFile(images_ + "/" + name));
  }
  static CObservation::Ptr camera(double seconds, const std::string& file) {
    auto observation = mrpt::obs::CObservationImage::Create();
    observation->timestamp = at(seconds);
    observation->sensorLabel = "camera";
    observation->image.setExternalStorage(file);
    return observation;
  }
  // A depth camera with range and points outside of the rawlog.
  CObservation::Ptr depth(double seconds) {
    auto observation = mrpt::obs::CObservation3DRangeScan::Create();
    observation->timestamp = at(seconds);
    observation->sensorLabel = "depth";
    observation->hasRangeImage = true;
    observation->rangeUnits = 0.001f;
    observation->cameraParams.setIntrinsicParamsFromValues(500, 500, 1.5, 1);
    observation->rangeImage_setSize(2, 3);
    observation->rangeImage.fill(1234);
    observation->hasPoints3D = true;
    observation->points3D_x = {1, 2};
    observation->points3D_y = {3, 4};
    observation->points3D_z = {5, 6};
    observation->rangeImage_convertToExternalStorage("depth_range.bin", images_ + "/");
    observation->points3D_convertToExternalStorage("depth_points.bin", images_ + "/");
    return observation;
  }

  testing::ScratchFolder folder_;
  std::string rawlog_ = folder_ / "walk.rawlog";
  std::string images_ = folder_ / "walk_Images";
};

TEST_F(ExternalImagesTest, imagesBesideTheRawlogAreLoadedBeforeAnObservationIsHandedOut) {
  saveImage("a.png", 200);
  writeGzip(rawlog_, (Bytes() << camera(1, "a.png")).string());
  RawlogSource source(rawlog_);
  const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(source.next());
  ASSERT_TRUE(observation);
  fs::remove_all(images_);
  EXPECT_EQ(observation->image.getWidth(), 8u) << "it is in memory";
  EXPECT_EQ(source.report().missing_images, 0u);
}

TEST_F(ExternalImagesTest, rangeImagesAndPointsAreLoaded) {
  writeGzip(rawlog_, (Bytes() << depth(1)).string());
  RawlogSource source(rawlog_);
  const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(source.next());
  ASSERT_TRUE(observation);
  ASSERT_EQ(observation->rangeImage.rows(), 2);
  EXPECT_EQ(observation->rangeImage(1, 2), 1234);
  EXPECT_EQ(observation->points3D_z, (decltype(observation->points3D_z){5, 6}));
}

TEST_F(ExternalImagesTest, missingFilesLeaveTheirObservationsOutAndAreCounted) {
  saveImage("a.png", 200);
  const auto with_depth = depth(4);
  fs::remove(images_ + "/depth_range.bin");
  writePlain(images_ + "/broken.png", "no png");
  writeGzip(rawlog_,
            (Bytes() << camera(1, "gone.png") << camera(2, "a.png") << camera(3, "broken.png") << with_depth << scan(5))
                .string());
  RawlogSource source(rawlog_);
  EXPECT_EQ(listing(readAll(source)), (std::vector<std::string>{"camera 2", "laser 5"}));
  const auto report = source.report();
  EXPECT_EQ(report.ending, SourceReport::Ending::complete);
  EXPECT_EQ(report.missing_images, 3u);
  EXPECT_EQ(report.first_missing_image, images_ + "/gone.png");
  EXPECT_EQ(report.exitCode(), base::ExitCode::missing_images);
}

// A header is enough to make a decoder allocate gigabytes.
TEST_F(ExternalImagesTest, aPictureOfAbsurdSizeIsNotDecoded) {
  const auto big_endian = [](std::uint32_t value, int bytes) {
    std::string text;
    for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i));
    return text;
  };
  writePlain(images_ + "/bomb.png",
             "\x89PNG\r\n\x1a\n" + big_endian(13, 4) + "IHDR" + big_endian(100000, 4) + big_endian(90000, 4));
  writePlain(images_ + "/bomb.jpg", "\xff\xd8\xff\xe0" + big_endian(4, 2) + "ab\xff\xff\xc0" + big_endian(11, 2) +
                                        "\x08" + big_endian(60000, 2) + big_endian(50000, 2));
  writeGzip(rawlog_, (Bytes() << camera(1, "bomb.png") << camera(2, "bomb.jpg") << scan(3)).string());
  RawlogSource source(rawlog_);
  EXPECT_EQ(readAll(source).size(), 1u);
  EXPECT_EQ(source.report().missing_images, 2u);
  EXPECT_NE(source.report().first_missing_image.find("bomb.png (has 100000 x 90000 pixels"), std::string::npos)
      << source.report().first_missing_image;
  writeGzip(rawlog_, (Bytes() << camera(2, "bomb.jpg")).string());
  RawlogSource of_jpeg(rawlog_);
  EXPECT_TRUE(readAll(of_jpeg).empty());
  EXPECT_NE(of_jpeg.report().first_missing_image.find("50000 x 60000 pixels"), std::string::npos)
      << of_jpeg.report().first_missing_image;
}

TEST_F(ExternalImagesTest, unwantedObservationsNeedNoFiles) {
  writeGzip(rawlog_, (Bytes() << camera(1, "gone.png") << scan(2)).string());
  SourceOptions options;
  options.labels = {"laser"};
  RawlogSource source(rawlog_, options);
  EXPECT_EQ(readAll(source).size(), 1u);
  EXPECT_EQ(source.report().missing_images, 0u);
}

TEST_F(ExternalImagesTest, theFolderCanBeNamed) {
  saveImage("a.png", 200);
  fs::rename(images_, folder_ / "elsewhere");
  writeGzip(rawlog_, (Bytes() << camera(1, "a.png")).string());
  SourceOptions options;
  options.images_folder = folder_ / "elsewhere";
  RawlogSource source(rawlog_, options);
  EXPECT_EQ(readAll(source).size(), 1u);
}

TEST_F(ExternalImagesTest, theFolderOfTheProcessIsPutBack) {
  saveImage("a.png", 200);
  writeGzip(rawlog_, (Bytes() << camera(1, "a.png") << camera(2, "gone.png")).string());
  mrpt::io::setLazyLoadPathBase("/somewhere");
  RawlogSource source(rawlog_);
  readAll(source);
  EXPECT_EQ(mrpt::io::getLazyLoadPathBase(), "/somewhere");
  mrpt::io::setLazyLoadPathBase(".");
}

}  // namespace
}  // namespace omnimapper::source::external_images_test
