#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "Corners.h"

namespace omnimapper::signs {

/// A plate, and what is written on it.
struct Plate {
  Corners quad;                    ///< its outline [px]
  double score = 0;                ///< how much of its outline is an edge, 0 to 1; 0 where no outline was found
  std::vector<std::size_t> lines;  ///< indices of the lines of text that are on it, from top to bottom
};

/// The plates that lines of text are written on. About each line, straight edges across which the colour changes are
/// sought on its four sides; of the quadrilaterals of four such edges that is taken which has edges all along its
/// outline, is large, holds many lines and cuts none. A line that no outline was found for has a plate of its own,
/// somewhat larger than the line. Each line is on one plate.
///
/// `picture` is of 8 bits, BGR. The same picture gives the same bits.
std::vector<Plate> findPlates(const cv::Mat& picture, const std::vector<Corners>& lines);

}  // namespace omnimapper::signs
