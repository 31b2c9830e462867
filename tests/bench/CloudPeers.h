#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace omnimapper::bench {

/// A method that finds planes in a cloud.
struct CloudPeer {
  std::string name;
  /// Receives a cloud, already averaged over cubes of 2.5 cm if the peer does not average itself. Not timed.
  std::function<void(const std::vector<Eigen::Vector3f>&)> take;
  /// Finds the planes. Timed.
  std::function<void()> run;
  /// For each point of the cloud the number of its plane, from 1 on, or 0. Not timed.
  std::function<std::vector<std::uint16_t>()> labels;
};

/// PCL's methods; empty if bench-cloud_planes was built without PCL.
std::vector<CloudPeer> pclCloudPlanes(double tolerance, int min_points);

}  // namespace omnimapper::bench
