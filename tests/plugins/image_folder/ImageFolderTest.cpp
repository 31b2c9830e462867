#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>

#include "image_folder/ImageFolder.h"

namespace omnimapper::source {
namespace {

class ImageFolderTest : public ::testing::Test {
 protected:
  void write(const std::string& name, int width, int height) const {
    mrpt::img::CImage image(width, height, mrpt::img::CH_RGB);
    image.filledRectangle(0, 0, width - 1, height - 1, mrpt::img::TColor(10, 200, 30));
    ASSERT_TRUE(image.saveToFile(folder_ / name));
  }
  static mrpt::obs::CObservationImage::Ptr nextOf(ImageFolder& images) {
    return std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(images.next());
  }

  testing::ScratchFolder folder_;
};

TEST_F(ImageFolderTest, imagesComeInTheOrderOfTheirNames) {
  write("b.png", 40, 30);
  write("a.jpg", 64, 48);
  write("a.mask.png", 64, 48);
  ImageFolder images(folder_.path(), {"photo", 2, 0});
  const auto first = nextOf(images), second = nextOf(images);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(images.next(), nullptr);
  EXPECT_EQ(first->sensorLabel, "photo");
  EXPECT_EQ(first->image.getWidth(), 64u);
  EXPECT_EQ(first->cameraParams.fx(), 64);
  EXPECT_EQ(first->cameraParams.cy(), 23.5);
  EXPECT_EQ(base::secondsBetween(first->timestamp, second->timestamp), 0.5);
  // Its axis is the base's x, and what is right in the image is right of the base.
  EXPECT_NEAR(first->cameraPose.composePoint(mrpt::math::TPoint3D(0, 0, 1)).x, 1, 1e-9);
  EXPECT_NEAR(first->cameraPose.composePoint(mrpt::math::TPoint3D(1, 0, 0)).y, -1, 1e-9);
  EXPECT_FALSE(images.areNamesTimes());
  EXPECT_EQ(images.report().ending, SourceReport::Ending::complete);
}

TEST_F(ImageFolderTest, namesThatAreTimesAreTheStamps) {
  write("1500000000.25.png", 8, 8);
  write("1500000001.50.png", 8, 8);
  ImageFolder images(folder_.path(), {"photo", 2, 500});
  const auto first = nextOf(images), second = nextOf(images);
  EXPECT_TRUE(images.areNamesTimes());
  EXPECT_EQ(first->timestamp, base::stampFromUnix(1500000000.25));
  EXPECT_EQ(base::secondsBetween(first->timestamp, second->timestamp), 1.25);
  EXPECT_EQ(first->cameraParams.fx(), 500);
}

TEST_F(ImageFolderTest, whatIsNoImageIsLeftOutAndCounted) {
  write("good.png", 8, 8);
  std::ofstream(folder_ / "empty.jpg");
  std::ofstream(folder_ / "text.png") << "no image";
  std::filesystem::create_directory(folder_ / "folder.png");
  ImageFolder images(folder_.path());
  EXPECT_TRUE(nextOf(images));
  EXPECT_EQ(images.next(), nullptr);
  EXPECT_EQ(images.report().missing_images, 3u);
  EXPECT_NE(images.report().first_missing_image.find("empty.jpg"), std::string::npos);
}

std::string bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A decoder fills the missing part with grey. The preview that cameras put before the image has an end marker, too.
TEST_F(ImageFolderTest, imagesWithoutTheirEndAreLeftOutAndCounted) {
  write("whole.jpg", 200, 100);
  write("whole.png", 200, 100);
  const std::string jpeg = bytesOf(folder_ / "whole.jpg"), png = bytesOf(folder_ / "whole.png");
  const std::string with_preview =
      jpeg.substr(0, 2) + std::string("\xff\xe1\0\x06\xff\xd8\xff\xd9", 8) + jpeg.substr(2);
  const auto save = [&](const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  };
  save("preview.jpg", with_preview);
  save("signed.jpg", jpeg + "what another program adds");
  save("padded.png", png + std::string(1000, '\0'));
  save("cut.jpg", jpeg.substr(0, jpeg.size() - 2));
  save("cut_preview.jpg", with_preview.substr(0, with_preview.size() - 40));
  save("cut.png", png.substr(0, png.size() - 12));
  save("cut_header.png", png.substr(0, 30));
  ImageFolder images(folder_.path());
  int count = 0;
  while (images.next()) ++count;
  EXPECT_EQ(count, 5) << "two whole ones, that with a preview, and those with something behind them";
  EXPECT_EQ(images.report().missing_images, 4u);
  EXPECT_NE(images.report().first_missing_image.find("cut.jpg: its end is missing"), std::string::npos);
}

TEST_F(ImageFolderTest, depthImagesAreNoPhotographs) {
  write("photo.png", 8, 8);
  const auto isRecognized = [&] { return ImageFolder::recognizes(LogLook::at(folder_.path())); };
  EXPECT_TRUE(isRecognized());
  std::ofstream(folder_ / "deep.png", std::ios::binary) << draw::encodePng(draw::Grey16Image{2, 1, {0x8000, 0x1000}});
  EXPECT_FALSE(isRecognized());
  ImageFolder images(folder_.path());
  const auto image = nextOf(images);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->image.getWidth(), 8u);
  EXPECT_EQ(images.next(), nullptr);
  EXPECT_NE(images.report().first_missing_image.find("deep.png: has 16 bits of grey"), std::string::npos);
}

TEST_F(ImageFolderTest, aFolderWithoutImagesIsRefused) {
  EXPECT_THROW(ImageFolder(folder_.path()), base::Error);
  EXPECT_THROW(ImageFolder(folder_ / "missing"), base::Error);
}

TEST_F(ImageFolderTest, isRecognizedIfThereAreImagesAndTextsAlone) {
  const auto isRecognized = [&] { return ImageFolder::recognizes(LogLook::at(folder_.path())); };
  EXPECT_FALSE(isRecognized()) << "empty";
  for (const char* name : {"a.JPG", "a.mask.png", "notes.txt"}) std::ofstream(folder_ / name) << "x";
  EXPECT_TRUE(isRecognized());
  std::ofstream(folder_ / "report.html") << "x";
  EXPECT_FALSE(isRecognized()) << "as the folder of a run has it";
  std::filesystem::remove(folder_ / "report.html");
  std::ofstream(folder_ / "frame-000000.depth.png") << "x";
  EXPECT_FALSE(isRecognized()) << "a folder of RGB-D images";
}

}  // namespace
}  // namespace omnimapper::source
