#pragma once

#include <omnimapper/camera/DepthImage.h>
#include <omnimapper/matching/RgbdPyramid.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace omnimapper::matching {

class FeatureSet {
 public:
  /// A corner, where the camera sees it.
  struct Corner {
    Eigen::Vector3d seen;   // column, row [px], inverse depth [1/m]
    Eigen::Vector3d point;  // optical frame [m]
    double scale;           // factor on its error, relative to a corner of the finest level
  };
  using Descriptor = std::array<std::uint64_t, 4>;

  /// At most `most` corners that have a depth, spread over the image.
  FeatureSet(const RgbdPyramid& image, int most);

  camera::Pinhole camera;
  std::vector<Corner> corners;
  std::vector<Descriptor> descriptors;
};

}  // namespace omnimapper::matching
