#pragma once

#include <omnimapper/camera/ColourImage.h>

#include <opencv2/core.hpp>

namespace omnimapper::signs {

/// A view of the pixels without a copy; empty for a picture without pixels. Throws as SignDetector::detect().
cv::Mat matOf(const camera::ColourImage& picture);

/// The pixels in one channel; pixels that have one channel already are not copied.
cv::Mat greyOf(const cv::Mat& pixels, camera::ColourImage::Order order);

}  // namespace omnimapper::signs
