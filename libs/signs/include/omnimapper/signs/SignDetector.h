#pragma once

#include <omnimapper/camera/ColourImage.h>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace omnimapper::signs {

/// The upper left, upper right, lower right and lower left corner [px], as the text is read: x to the right, y down,
/// (0, 0) is the middle of the upper left pixel.
using Corners = std::array<Eigen::Vector2f, 4>;

/// A region of a picture that may be a door sign.
struct SignRegion {
  Corners corners_px;
  double score = 0;  ///< probability that the region is a sign, 0 to 1
};

/// Finds door signs in a picture of 8 bits. Pure and thread-safe; the same picture gives the same bits.
class SignDetector {
 public:
  virtual ~SignDetector() = default;
  /// The signs, best score first; none in a picture without pixels. Throws Error(unreadable_input) if the description
  /// of the picture is invalid: a size below 0, rows longer than their stride, or no memory.
  virtual std::vector<SignRegion> detect(const camera::ColourImage& picture) const = 0;
};

}  // namespace omnimapper::signs
