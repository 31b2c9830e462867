#pragma once

#include <mrpt/img/CImage.h>
#include <omnimapper/perception/ColourImage.h>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace omnimapper::signs {

/// Upper left, upper right, lower right, lower left, as the text is read [px]: x to the right, y down, (0, 0) the
/// middle of the upper left pixel.
using Corners = std::array<Eigen::Vector2f, 4>;

/// A region of a picture that may be a door sign.
struct SignRegion {
  Corners corners_px;
  double score = 0;  ///< probability that it is a sign, 0 to 1
};

/// Finds door signs in a picture of 8 bits. Pure and thread-safe; the same picture gives the same bits.
class SignDetector {
 public:
  virtual ~SignDetector() = default;
  /// Best first. None in a picture without pixels. Throws Error(unreadable_input) for a picture that is described
  /// wrongly: a size below 0, rows longer than their stride, no memory.
  virtual std::vector<SignRegion> detect(const perception::ColourImage& picture) const = 0;
};

/// The pixels of a picture, which must outlive them. Throws Error(unreadable_input) if they are not of 8 bits with one
/// or three channels, and Error(missing_images) if they are in a file that was not loaded and is not there.
perception::ColourImage pixelsOf(const mrpt::img::CImage& picture);

}  // namespace omnimapper::signs
