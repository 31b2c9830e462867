#pragma once

#include <omnimapper/sim/Simulation.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// The truth about objects: objects.csv, objects_seen.csv and a mesh of each object in objects/.
///
/// objects.csv has a line for each object and each place at which it stands: object (its name in landmarks.json),
/// shape, moveable (0 or 1), mesh (its file), length_m, width_m, height_m (extents along its own axes), from_s (time
/// from which it is there), on (the surface that it stands on, or the person who carries it; empty: it is away),
/// in_motion (1: it is carried visibly until the next line), x_m, y_m, z_m, qx, qy, qz, qw (pose in the map at from_s;
/// empty: it is away).
///
/// objects_seen.csv has a line for each object that a camera image of the log shows, in the log's order. Columns: stamp
/// (Unix time [s]), sensor (its label), measurement (its number), object, and the members of ObjectView: pixels,
/// depth_pixels, left_px, top_px, right_px, bottom_px, distance_m.
class TrueObjects {
 public:
  explicit TrueObjects(const Simulation& simulation);

  void add(const Sensor& sensor, int k, const std::vector<ObjectView>& objects);
  /// Writes the files if there are objects, objects_seen.csv only if there is a camera. Returns their names relative to
  /// the folder; a folder of many files ends in a slash.
  std::vector<std::string> write(const std::string& folder) const;

 private:
  const World& world_;
  bool has_camera_;
  std::string seen_;
};

}  // namespace omnimapper::sim
