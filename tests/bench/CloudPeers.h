#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace omnimapper::bench {

/// Somebody's way from a cloud to planes.
struct CloudPeer {
  std::string name;
  /// Hands over a cloud, averaged over cubes of 2.5 cm beforehand if the peer does not do that itself; not timed.
  std::function<void(const std::vector<Eigen::Vector3f>&)> take;
  /// Timed.
  std::function<void()> run;
  /// For each point that was handed over the number of its plane from 1 on, or 0; not timed.
  std::function<std::vector<std::uint16_t>()> labels;
};

/// None where bench-cloud_planes was built without it.
std::vector<CloudPeer> pclCloudPlanes(double tolerance, int min_points);

}  // namespace omnimapper::bench
