#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/surfaces/CellGrid.h>
#include <omnimapper/surfaces/SurfaceClass.h>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::surfaces {

/// A flat area with holes. All corners lie on one plane [m]; the last joins the first.
struct FlatPart {
  std::vector<Eigen::Vector3d> outline;
  std::vector<std::vector<Eigen::Vector3d>> holes;
};

/// Which way is up in the frame of a set, where that need not be z.
struct SurfaceSetLevel {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit
  std::string from;                               ///< "imu", "planes", "base" or "unknown"
  double standard_deviation = 0;                  ///< [rad]
};

/// One flat surface of a place, as it truly is or as a map has it. Frame: the map's [m].
struct Surface {
  int id = 0;        ///< of the truth any number above 0, in a map that of the landmark; unique in its set
  std::string name;  ///< "kitchen/wall_2", or of a map the landmark's name
  std::string body;  ///< of the true ones: what it is a side of; else empty
  SurfaceClass is = SurfaceClass::surface;
  std::string reason;  ///< of a map: why it is called so; else empty
  geometry::Plane3 plane;
  std::vector<FlatPart> parts;
  /// Of the truth: what a beam or a pixel of the log hit from within 4 m at under 75 deg. None: nobody looked.
  std::optional<CellGrid> seen;
  bool is_moved = false;      ///< of the truth: it is elsewhere at some time of the log
  int measurements = 0;       ///< of a map: how often it was seen
  bool is_candidate = false;  ///< of a map: seen too little to be drawn
};

/// Where one goes or looks from a room into another.
struct Opening {
  enum class Kind { door, passage, window };
  enum class Leaf { none, open, closed };
  std::string name;
  Kind kind = Kind::door;
  std::array<std::string, 2> rooms;  ///< the second may be "outside"
  /// Corners on the wall of the first room, who stands in it sees them as lower left, lower right, upper right, upper
  /// left [m].
  std::array<Eigen::Vector3d, 4> rectangle;
  Leaf leaf = Leaf::none;
  double leaf_angle = 0;  ///< by which an open leaf is turned into the first room [rad]
  std::string leaf_body;  ///< Surface::body of its faces; empty without a leaf
};

/// The flat surfaces and openings of a place.
struct SurfaceSet {
  std::string title;  ///< of the place
  std::vector<Surface> surfaces;
  std::vector<Opening> openings;
  std::optional<SurfaceSetLevel> level = std::nullopt;  ///< none: z is up
};

/// The same place in frame b.
SurfaceSet moved(SurfaceSet set, const geometry::Se3& b_from_a);

/// The file surfaces.json, UTF-8, byte for byte the same for the same set: {"format": "omnimapper surfaces 1", ...}.
std::string toJson(const SurfaceSet& set);
/// Throws base::Error(unreadable_input) naming `file` and the place in it.
SurfaceSet readSurfaces(const std::string& file);

/// [m^2], outlines less holes.
double areaOf(const Surface& surface);
/// All corners of all outlines.
std::vector<Eigen::Vector3d> cornersOf(const Surface& surface);

}  // namespace omnimapper::surfaces
