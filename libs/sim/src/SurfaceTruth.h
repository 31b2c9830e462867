#pragma once

#include <omnimapper/sim/Sensor.h>
#include <omnimapper/sim_world/Patches.h>
#include <omnimapper/surfaces/SurfaceSet.h>

#include <ostream>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// The true surfaces of a world and what of them the measurements of a log have shown: surfaces.json and world.ply.
class SurfaceTruth {
 public:
  /// `world` must outlive it.
  explicit SurfaceTruth(const World& world);

  /// Points of a measurement in the log, taken at that time [s].
  void add(const std::vector<SeenPoint>& seen, double time);

  /// Patches over 0.05 m^2 where they are at time 0, each with the cells of 5 cm that were seen, or no cells where
  /// nobody saw any; those of bodies that are nowhere then are left out. Openings.
  surfaces::SurfaceSet surfaces(const std::string& title) const;

 private:
  const World& world_;
  std::vector<Patch> patches_;
  std::vector<surfaces::CellGrid> seen_;            // of each patch, in the frame of its body
  std::vector<std::vector<std::size_t>> patch_of_;  // by the number of a surface
  std::vector<int> body_of_;                        // the same
};

/// Binary PLY of all triangles at time 0, in the map [m]: "surface" of a face is the label of landmarks.json, "class"
/// the place of its class in surfaces::allSurfaceClasses(), which comments name.
void writeMesh(std::ostream& out, const World& world);

}  // namespace omnimapper::sim
