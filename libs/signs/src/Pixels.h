#pragma once

#include <omnimapper/perception/ColourImage.h>

#include <opencv2/core.hpp>

namespace omnimapper::signs {

/// The same pixels, not copied; empty for a picture without any. Throws as SignDetector::detect().
cv::Mat matOf(const perception::ColourImage& picture);

/// One channel; the same pixels where they have one already.
cv::Mat greyOf(const cv::Mat& pixels, perception::ColourImage::Order order);

}  // namespace omnimapper::signs
