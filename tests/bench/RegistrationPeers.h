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
  std::optional<geometry::Matrix6d> covariance;  ///< of that motion, if the method estimates it
};

/// A method that estimates the motion between two images. The whole call of `run` is timed, reading the files is not.
struct RegistrationPeer {
  std::string name;
  std::string row;  ///< row of the thesis's Table 8 to which it belongs
  int every = 1;    ///< only every n-th pair is tried, for slow methods
  /// first_from_second (optical frames), from a guess of it. None if the method itself reports that it failed.
  std::function<std::optional<Registered>(const RgbdFrame& first, const RgbdFrame& second, const geometry::Se3& guess)>
      run;
};

/// PCL's methods: ICP and GICP of edges, voxels and all points. Empty if bench-registration was built without PCL.
std::vector<RegistrationPeer> pclRegistrations();

}  // namespace omnimapper::bench
