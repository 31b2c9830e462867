#pragma once

#include <omnimapper/sim/Sensor.h>
#include <omnimapper/sim_world/Patches.h>
#include <omnimapper/surfaces/SurfaceSet.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// The true surfaces of a world with the parts that the measurements of a log show: surfaces.json.
class SurfaceTruth {
 public:
  /// `world` must outlive it.
  explicit SurfaceTruth(const World& world);

  /// Adds the points of a measurement of the log, which was taken at `time` [s].
  void add(const std::vector<VisiblePoint>& seen, double time);

  /// Patches over 0.05 m^2 at their places at time 0, each with the cells of 5 cm that were seen, if any, and openings.
  /// Patches of bodies that are not in the world at time 0 are left out.
  surfaces::SurfaceSet surfaces(const std::string& title) const;

 private:
  const World& world_;
  std::vector<Patch> patches_;
  std::vector<surfaces::CellGrid> seen_;            // seen cells of each patch, in the frame of its body
  std::vector<std::vector<std::size_t>> patch_of_;  // indices of the patches of each surface, by its number
  std::vector<int> body_of_;                        // index of the body of each surface, by its number
};

}  // namespace omnimapper::sim
