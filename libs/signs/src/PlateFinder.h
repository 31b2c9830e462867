#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "Corners.h"

namespace omnimapper::signs {

/// A plate with the lines of text on it.
struct Plate {
  Corners quad;                    ///< its outline [px]
  double score = 0;                ///< share of its outline that is an edge, 0 to 1; 0 if no outline was found
  std::vector<std::size_t> lines;  ///< indices of the lines of text that are on it, from top to bottom
};

/// Finds the plates that lines of text are written on. On the four sides of each line, straight edges with a change of
/// colour are sought; of the quadrilaterals of four such edges, the one is taken that has edges all along its outline,
/// is large, holds many lines and cuts none. A line without such an outline gets a separate plate, somewhat larger than
/// the line. Each line is on exactly one plate.
///
/// `picture` is of 8 bits, BGR. The same picture gives the same bits.
std::vector<Plate> findPlates(const cv::Mat& picture, const std::vector<Corners>& lines);

}  // namespace omnimapper::signs
