#pragma once

#include <omnimapper/camera/DepthImage.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "../planes/InverseDepth.h"
#include "../planes/PlaneMoments.h"

namespace omnimapper::perception::road {

/// The ground around each cell of an image, as planes fitted to pixels that are surely ground, and how far each pixel
/// is from it.
struct LocalGround {
  static constexpr int kSteps = 1000;  ///< steps that make up the reach: sums of whole numbers are exact
  static constexpr int kFarthest = kSteps * 3 / 2;
  static constexpr std::int16_t kUnknown = INT16_MAX;

  int width = 0, height = 0;
  double step = 0;            ///< [1/m] unit of the distances in `offs`
  int columns = 0, rows = 0;  ///< of cells of planes::kCell pixels
  camera::Pinhole camera;
  std::vector<std::optional<planes::ImagePlane>>
      planes;  ///< of each cell, row by row; none where little ground is near
  /// How much nearer than the ground each pixel is, row by row, as a difference of 1/z in units of `step`, clipped to
  /// +-kFarthest; kUnknown where the pixel or the ground is not known.
  std::vector<std::int16_t> offs;

  const std::optional<planes::ImagePlane>& planeAt(int x, int y) const {
    return planes[static_cast<std::size_t>(y / planes::kCell * columns + x / planes::kCell)];
  }
  /// 1/z of the ground at a pixel [1/m], interpolated between the planes of the cells around it, so that it is
  /// continuous at their borders. At least one of these cells must have a plane.
  double between(double x, double y) const;
};

/// `seeds`: 1 for pixels that are surely ground, row by row. `reach` [1/m]: the distance from the
/// ground that is kSteps steps.
LocalGround fitGround(const planes::InverseDepth& inverse, const camera::Pinhole& camera,
                      const std::vector<std::uint8_t>& seeds, double reach);

}  // namespace omnimapper::perception::road
