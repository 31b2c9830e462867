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
  int id = 0;        ///< a number above 0 that is unique in the set
  std::string name;  ///< for a true surface, for example "kitchen/wall_2"; for a surface of a map, the landmark's name
  std::string body;  ///< for a true surface: the body of which it is a side; else empty
  SurfaceClass is = SurfaceClass::surface;
  std::string reason;  ///< for a surface of a map: the reason for its class; else empty
  geometry::Plane3 plane;
  std::vector<FlatPart> parts;
  /// For a true surface: the cells that a beam or pixel of the log hit from at most 4 m away and at most 75 deg from
  /// the surface's normal. None: not recorded.
  std::optional<CellGrid> seen;
  bool is_moved = false;      ///< for a true surface: it is somewhere else at some time of the log
  int measurements = 0;       ///< for a surface of a map: number of measurements
  bool is_candidate = false;  ///< for a surface of a map: measured too rarely, or too rough, to be drawn
};

/// An opening through which people go or look from one room into another.
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
  std::string leaf_body;  ///< Surface::body of the leaf's faces; empty without a leaf
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

/// The content of a file surfaces.json in UTF-8: {"format": "omnimapper surfaces 1", ...}. The same set always gives
/// the same bytes.
std::string toJson(const SurfaceSet& set);
/// Reads a file of toJson(). Throws base::Error(unreadable_input), which names `file` and the place in it.
SurfaceSet readSurfaces(const std::string& file);

/// Area of the outlines without the holes [m^2].
double areaOf(const Surface& surface);
/// All corners of all outlines.
std::vector<Eigen::Vector3d> cornersOf(const Surface& surface);

}  // namespace omnimapper::surfaces
