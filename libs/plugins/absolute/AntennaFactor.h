#pragma once

#include <omnimapper/graph/Factor.h>
#include <omnimapper/graph/FactorRegistry.h>

#include <Eigen/Core>

namespace omnimapper::plugins {

/// The position of an antenna, which is mounted on the base, in the local east-north-up frame. Variables: map_from_enu,
/// map_from_base (se3). Residual: inverse(map_from_enu) * map_from_base * antenna_in_base - the measured
/// antenna_in_enu, along the axes east, north and up [m]. Without `up`, for a planar map, there are only the first two
/// rows. Source: thesis 5.2.2.2; derivation in doc/derivations/antenna.md.
class AntennaFactor : public graph::Factor {
 public:
  AntennaFactor(const Eigen::Vector3d& antenna_in_base, const Eigen::Vector3d& antenna_in_enu, bool up)
      : antenna_in_base_(antenna_in_base), antenna_in_enu_(antenna_in_enu), up_(up) {}

  std::string_view kind() const override { return "antenna"; }
  int residualSize() const override { return up_ ? 3 : 2; }
  const std::vector<std::string_view>& variableKinds() const override;
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override;
  void write(std::ostream& out) const override;
  /// Registers the function that reads such factors from files.
  static void addTo(graph::FactorRegistry& registry);

 private:
  Eigen::Vector3d antenna_in_base_, antenna_in_enu_;
  bool up_;
};

}  // namespace omnimapper::plugins
