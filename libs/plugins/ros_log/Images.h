#pragma once

#include <mrpt/img/TCamera.h>

#include <opencv2/core.hpp>

#include "Value.h"

namespace omnimapper::ros {

/// Whether the images of an encoding or of a format of compression hold depths.
bool isDepthEncoding(std::string_view encoding);

/// The picture of an Image or CompressedImage: 8 bits, grey or blue, green and red. Throws BadBytes for an encoding
/// that is not read, and for pixels that are missing.
cv::Mat pictureOf(const Value& message);

/// The depths of an Image or CompressedImage along the optical axis [mm]; 0: none. Depths beyond 65 m are none.
cv::Mat depthsOf(const Value& message);

/// The camera of a CameraInfo: for rectified images the one that the rectification made. Throws BadBytes for a lens
/// that is not described by OpenCV's coefficients.
mrpt::img::TCamera cameraOf(const Value& info, bool is_rectified);

}  // namespace omnimapper::ros
