#pragma once

#include <mrpt/img/CImage.h>
#include <omnimapper/camera/ColourImage.h>

#include <opencv2/core.hpp>

namespace omnimapper::signs {

/// A view of the pixels without a copy; empty for a picture without pixels. Throws as SignDetector::detect().
cv::Mat matOf(const camera::ColourImage& picture);

/// The pixels in one channel; pixels that have one channel already are not copied.
cv::Mat greyOf(const cv::Mat& pixels, camera::ColourImage::Order order);

/// A view of the pixels of `picture`, which must outlive the view. Throws Error(unreadable_input) if the picture does
/// not have 8 bits and one or three channels, and Error(missing_images) if the picture is in a file that was not loaded
/// and is missing.
camera::ColourImage pixelsOf(const mrpt::img::CImage& picture);

}  // namespace omnimapper::signs
