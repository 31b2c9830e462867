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

/// A flat area with holes. All corners lie on one plane [m]; the last is connected to the first.
struct FlatPart {
  std::vector<Eigen::Vector3d> outline;
  std::vector<std::vector<Eigen::Vector3d>> holes;
};

/// Direction of up in the frame of a set, for frames whose z axis need not be up.
struct SurfaceSetLevel {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit
  std::string from;                               ///< "imu", "planes", "base" or "unknown"
  double standard_deviation = 0;                  ///< [rad]
};

/// One flat surface of a place, either a true one or one of a map, in the frame of the set [m].
struct Surface {
  int id = 0;        ///< of a true surface any number above 0, of a map that of the landmark; unique in its set
  std::string name;  ///< of a true surface such as "kitchen/wall_2", of a map the landmark's name
  std::string body;  ///< of a true surface: the body that it is a side of; else empty
  SurfaceClass is = SurfaceClass::surface;
  std::string reason;  ///< of a map: the reason for its class; else empty
  geometry::Plane3 plane;
  std::vector<FlatPart> parts;
  /// Of a true surface: cells that a beam or pixel of the log hit from within 4 m at under 75 deg. None: not recorded.
  std::optional<CellGrid> seen;
  bool is_moved = false;      ///< of a true surface: it is elsewhere at some time of the log
  int measurements = 0;       ///< of a map: number of measurements
  bool is_candidate = false;  ///< of a map: measured too rarely to be drawn
};

/// An opening through which one goes or looks from one room into another.
struct Opening {
  enum class Kind { door, passage, window };
  enum class Leaf { none, open, closed };
  std::string name;
  Kind kind = Kind::door;
  std::array<std::string, 2> rooms;  ///< the second may be "outside"
  /// Corners on the wall of the first room [m]: lower left, lower right, upper right, upper left as seen from that
  /// room.
  std::array<Eigen::Vector3d, 4> rectangle;
  Leaf leaf = Leaf::none;
  double leaf_angle = 0;  ///< angle by which an open leaf is turned into the first room [rad]
  std::string leaf_body;  ///< Surface::body of its faces; empty without a leaf
};

/// The flat surfaces and openings of a place.
struct SurfaceSet {
  std::string title;  ///< of the place
  std::vector<Surface> surfaces;
  std::vector<Opening> openings;
  std::optional<SurfaceSetLevel> level = std::nullopt;  ///< none: z is up
};

/// The same set in frame b.
SurfaceSet moved(SurfaceSet set, const geometry::Se3& b_from_a);

/// The file surfaces.json, UTF-8, byte for byte the same for the same set: {"format": "omnimapper surfaces 1", ...}.
std::string toJson(const SurfaceSet& set);
/// Reads a file of toJson(). Throws base::Error(unreadable_input) that names `file` and the place in it.
SurfaceSet readSurfaces(const std::string& file);

/// Area of the outlines without the holes [m^2].
double areaOf(const Surface& surface);
/// All corners of all outlines.
std::vector<Eigen::Vector3d> cornersOf(const Surface& surface);

}  // namespace omnimapper::surfaces
