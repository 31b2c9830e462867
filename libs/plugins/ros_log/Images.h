#pragma once

#include <mrpt/img/TCamera.h>

#include <opencv2/core.hpp>

#include "Value.h"

namespace omnimapper::ros {

/// What images hold. Grey values of 16 bits are those of an infrared camera, or depths.
enum class ImageContent { picture, depths, deep_grey };

/// By the encoding or the format of compression. mono16 says nothing about the unit of its values: they are depths if
/// `topic` has "depth" in its name, and else deep_grey, which is not used.
ImageContent imageContentOf(std::string_view encoding, std::string_view topic);

/// The picture of an Image or CompressedImage: 8 bits, grey or blue, green and red. Throws BadBytes for an encoding
/// that is not read, and for pixels that are missing.
cv::Mat pictureOf(const Value& message);

/// The depths of an Image or CompressedImage along the optical axis [mm]; 0: none. Depths beyond 65 m are none. Throws
/// BadBytes as pictureOf() does.
cv::Mat depthsOf(const Value& message);

/// The camera of a CameraInfo: for rectified images the one that the rectification made. Throws BadBytes for a lens
/// that is not described by OpenCV's coefficients.
mrpt::img::TCamera cameraOf(const Value& info, bool is_rectified);

}  // namespace omnimapper::ros
