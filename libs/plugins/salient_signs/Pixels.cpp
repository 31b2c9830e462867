#include "Pixels.h"

#include <omnimapper/base/Error.h>

#include <opencv2/imgproc.hpp>
#include <string>

namespace omnimapper::signs {

using camera::ColourImage;

cv::Mat matOf(const ColourImage& picture) {
  if (picture.width == 0 || picture.height == 0) return {};
  const int channels = picture.order == ColourImage::Order::grey ? 1 : 3;
  if (!picture.pixels || picture.width < 0 || picture.height < 0 || picture.stride / channels < picture.width) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "a picture of " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                          " pixels cannot have rows of " + std::to_string(picture.stride) +
                          " bytes: " + "give its true size and stride");
  }
  // OpenCV has no matrix of constant pixels, but this one is never written to.
  return cv::Mat(picture.height, picture.width, CV_8UC(channels), const_cast<std::uint8_t*>(picture.pixels),
                 static_cast<std::size_t>(picture.stride));
}

cv::Mat greyOf(const cv::Mat& pixels, ColourImage::Order order) {
  if (pixels.empty() || order == ColourImage::Order::grey) return pixels;
  cv::Mat grey;
  cv::cvtColor(pixels, grey, order == ColourImage::Order::rgb ? cv::COLOR_RGB2GRAY : cv::COLOR_BGR2GRAY);
  return grey;
}

ColourImage pixelsOf(const mrpt::img::CImage& picture) {
  if (picture.isEmpty()) return {};
  cv::Mat pixels;
  try {
    pixels = picture.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
  } catch (const mrpt::img::CExceptionExternalImageNotFound& error) {
    throw base::Error(base::ExitCode::missing_images,
                      std::string("a picture is missing: ") + error.what() + ". Put it beside its log.");
  }
  if (pixels.depth() != CV_8U || (pixels.channels() != 1 && pixels.channels() != 3)) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "door signs are looked for in pictures of 8 bits with one or three channels; this one has " +
                          std::to_string(8 * pixels.elemSize1()) + " bits and " + std::to_string(pixels.channels()) +
                          " channels: convert it");
  }
  const auto order = pixels.channels() == 1                             ? ColourImage::Order::grey
                     : picture.getChannelsOrder() == std::string("RGB") ? ColourImage::Order::rgb
                                                                        : ColourImage::Order::bgr;
  return {pixels.data, pixels.cols, pixels.rows, static_cast<int>(pixels.step), order};
}

}  // namespace omnimapper::signs
