#pragma once

#include <mrpt/img/CImage.h>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace omnimapper::testing {

/// Columns and rows [px] of the corners of a marker's black square: top left, top right, bottom right, bottom left in
/// the orientation of its dictionary. The centre of a pixel has integer coordinates.
using MarkerCorners = std::array<Eigen::Vector2d, 4>;

/// A grey picture of ArUco markers, each on a white plate on a grey wall. Each pixel is the mean over its area.
class MarkerPicture {
 public:
  MarkerPicture(int width, int height);

  /// Draws a marker of ArUco's dictionary 4x4_50 in perspective.
  void draw(int id, const MarkerCorners& corners);

  mrpt::img::CImage grey() const;
  mrpt::img::CImage colour() const;

 private:
  int width_, height_;
  std::vector<std::uint8_t> pixels_;  // row by row
};

}  // namespace omnimapper::testing
