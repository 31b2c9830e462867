#pragma once

#include <omnimapper/geometry/Se3.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "RgbdFrames.h"

namespace omnimapper::bench {

struct Registered {
  geometry::Se3 first_from_second;
  std::optional<geometry::Matrix6d> covariance;  ///< of that, where the method tells
};

/// Somebody's way to the motion between two images; everything from the images on is timed.
struct RegistrationPeer {
  std::string name;
  std::string row;  ///< of the thesis's Table 8 that it belongs to
  int every = 1;    ///< only every n-th pair is tried: the method is slow
  /// first_from_second, optical frames, from a guess of it; nothing where the method itself says that it failed.
  std::function<std::optional<Registered>(const RgbdFrame& first, const RgbdFrame& second, const geometry::Se3& guess)>
      run;
};

/// PCL's edges, voxels, ICP and GICP; none where bench-registration was built without PCL.
std::vector<RegistrationPeer> pclRegistrations();

}  // namespace omnimapper::bench
