#pragma once

#include <mrpt/img/CImage.h>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace omnimapper::testing {

/// Columns and rows [px] of the corners of a marker's black square: top left, top right, bottom right, bottom left, as
/// its dictionary has it. The centre of a pixel has whole numbers.
using MarkerCorners = std::array<Eigen::Vector2d, 4>;

/// A grey picture of ArUco markers, a white plate around each, on a grey wall. Each pixel is the mean of what it
/// covers.
class MarkerPicture {
 public:
  MarkerPicture(int width, int height);

  /// A marker of ArUco's dictionary 4x4_50, seen in perspective.
  void draw(int id, const MarkerCorners& corners);

  mrpt::img::CImage grey() const;
  mrpt::img::CImage colour() const;

 private:
  int width_, height_;
  std::vector<std::uint8_t> pixels_;  // row by row
};

}  // namespace omnimapper::testing
