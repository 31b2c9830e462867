#pragma once

#include <omnimapper/perception/DepthImage.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "../planes/InverseDepth.h"
#include "../planes/PlaneMoments.h"

namespace omnimapper::perception::road {

/// The ground around each cell of an image, by planes fitted to pixels that are surely ground, and how far from it each
/// pixel is.
struct LocalGround {
  static constexpr int kSteps = 1000;  ///< of a distance from the ground, up to the reach: sums of whole ones are exact
  static constexpr int kFarthest = kSteps * 3 / 2;
  static constexpr std::int16_t kUnknown = INT16_MAX;

  int width = 0, height = 0;
  double step = 0;            ///< [1/m]
  int columns = 0, rows = 0;  ///< of cells of planes::kCell pixels
  Pinhole camera;
  std::vector<std::optional<planes::ImagePlane>>
      planes;  ///< of each cell, row by row; none where little ground is near
  /// Of each pixel, row by row: how much nearer than the ground, in steps of 1/z, clipped to +-kFarthest; kUnknown
  /// where it or the ground is not known.
  std::vector<std::int16_t> offs;

  const std::optional<planes::ImagePlane>& planeAt(int x, int y) const {
    return planes[static_cast<std::size_t>(y / planes::kCell * columns + x / planes::kCell)];
  }
  /// 1/z of the ground there [1/m], by the planes of the cells around it: changes steadily, as that of one cell and the
  /// next does not. There must be a plane.
  double between(double x, double y) const;
};

/// `seeds`: 1 for pixels that are surely ground, row by row. `reach` [1/m] is that of kSteps.
LocalGround fitGround(const planes::InverseDepth& inverse, const Pinhole& camera,
                      const std::vector<std::uint8_t>& seeds, double reach);

}  // namespace omnimapper::perception::road
