#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>

#include <opencv2/imgproc.hpp>

#include "PictureChanges.h"

namespace omnimapper::signs {
namespace {

using mrpt::obs::CObservationImage;

// A grey wall with a dark plate `shift` pixels to the right, a little noise that differs between images, and `light`
// added to all grey levels.
cv::Mat wall(int shift, int light, int seed) {
  cv::Mat picture(480, 640, CV_8UC3, cv::Scalar::all(150 + light));
  picture(cv::Rect(230 + shift, 150, 180, 130)) = cv::Scalar::all(60 + light);
  cv::Mat noise(picture.size(), CV_16SC3), noisy;
  cv::RNG random(static_cast<std::uint64_t>(seed));
  random.fill(noise, cv::RNG::NORMAL, 0, 6);
  cv::add(picture, noise, noisy, cv::noArray(), CV_8UC3);
  return noisy;
}

CObservationImage image(const cv::Mat& picture, const std::string& label = "camera") {
  CObservationImage observation;
  observation.sensorLabel = label;
  observation.cameraParams.setIntrinsicParamsFromValues(500, 500, 320, 240);
  observation.image = mrpt::img::CImage(picture, mrpt::img::DEEP_COPY);
  return observation;
}

TEST(PictureChanges, noiseAndLightAreNothingNewAndMotionIs) {
  PictureChanges changes(16);
  EXPECT_TRUE(changes.isNew(image(wall(0, 0, 1))));
  EXPECT_FALSE(changes.isNew(image(wall(0, 0, 2))));
  EXPECT_FALSE(changes.isNew(image(wall(0, 12, 3))));
  EXPECT_FALSE(changes.isNew(image(wall(1, 0, 4)))) << "a tenth of a reduced pixel";
  EXPECT_TRUE(changes.isNew(image(wall(5, 0, 5))));
  EXPECT_FALSE(changes.isNew(image(wall(5, 0, 6)))) << "the camera stands still again";
}

TEST(PictureChanges, whatCreepsIsSeen) {
  PictureChanges changes(16);
  changes.isNew(image(wall(0, 0, 1)));
  int count = 0;
  for (int shift = 1; shift <= 40; ++shift) count += changes.isNew(image(wall(shift, 0, shift)));
  EXPECT_GT(count, 5) << "each image is compared with the last new one, not with the one before";
  EXPECT_LT(count, 30);
}

TEST(PictureChanges, aSmallThingThatComesIsNew) {
  PictureChanges changes(16);
  changes.isNew(image(wall(0, 0, 1)));
  cv::Mat with_card = wall(0, 0, 2);
  with_card(cv::Rect(40, 400, 12, 12)) = cv::Scalar::all(20);
  EXPECT_TRUE(changes.isNew(image(with_card)));
}

TEST(PictureChanges, aCameraThatStandsElsewhereOrIsAnotherIsNew) {
  PictureChanges changes(16);
  const auto first = image(wall(0, 0, 1));
  EXPECT_TRUE(changes.isNew(first));
  auto turned = first;
  turned.cameraPose = mrpt::poses::CPose3D(0, 0, 0, 0.1, 0, 0);
  EXPECT_TRUE(changes.isNew(turned));
  auto calibrated = turned;
  calibrated.cameraParams.fx(501);
  EXPECT_TRUE(changes.isNew(calibrated));
  EXPECT_FALSE(changes.isNew(calibrated));
  EXPECT_TRUE(changes.isNew(image(wall(0, 0, 1), "another")));
  EXPECT_FALSE(changes.isNew(image(wall(0, 0, 2), "another")));
}

TEST(PictureChanges, whatCannotBeReadIsNew) {
  PictureChanges changes(16);
  CObservationImage missing = image(wall(0, 0, 1)), deep = missing, none;
  missing.image = mrpt::img::CImage();
  missing.image.setExternalStorage("not_there.png");
  deep.image = mrpt::img::CImage(cv::Mat(20, 30, CV_16UC1, cv::Scalar(1000)), mrpt::img::DEEP_COPY);
  for (const auto& observation : {missing, deep, none})
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(changes.isNew(observation));
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 3000), cv::Size(3000, 1)}) {
    const auto narrow = image(cv::Mat(size, CV_8UC1, cv::Scalar(7)));
    EXPECT_TRUE(changes.isNew(narrow)) << size;
    EXPECT_FALSE(changes.isNew(narrow)) << size;
  }
}

}  // namespace
}  // namespace omnimapper::signs
