#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/map/MapSection.h>
#include <omnimapper/map/Property.h>

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::map {

/// The part of the floor that an object covers, seen from above, and its height range. Frame of the map [m].
struct Extent {
  std::vector<Eigen::Vector2d> points;
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> lines;  ///< from, to
  std::vector<std::vector<Eigen::Vector2d>> outlines;              ///< closed; that of an upright surface has no area
  std::vector<std::vector<Eigen::Vector2d>> holes;                 ///< closed, cut out of the outlines
  double bottom = 0, top = 0;                                      ///< z of its lowest and highest point
};

/// A landmark as the answer to a query by name. It needs neither graph nor key frames.
struct Place {
  base::LandmarkId id;
  std::string kind;     ///< what it is counted as: "sign", "marker"
  std::string label;    ///< what a user calls it: "sign", "marker 12"
  std::string caption;  ///< the text on it; may be empty
  bool moved = false;   ///< gone; the other members describe it as it was
  std::vector<Property> properties;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] middle of its extent, or its last position
  Extent extent;
  std::optional<Eigen::Vector3d> normal;     ///< unit, points to the free side
  std::optional<Eigen::Vector3d> seen_from;  ///< unit, from it towards the viewpoints; none if seen from all around
  std::uint32_t measurements = 0;
  std::map<std::string, std::uint64_t> seen_by;  ///< measurements by sensor label, as far as they are known
  base::Stamp first_seen, last_seen;
  /// Standard deviation of its position in the least certain direction [m]; none if it is unknown.
  std::optional<double> sigma;
  bool sigma_is_along_normal = false;  ///< true for a plane or wall: `sigma` is that of its distance along the normal
};

/// The property of a place that stands for several landmarks, the faces of a thing: their ids, as in "0:12, 0:15".
inline constexpr char kParts[] = "parts";

/// Where the base was when the map was written. Frame of the map [m] [rad].
struct LastPose {
  double x = 0, y = 0, yaw = 0;
  base::Stamp stamp;
  std::uint16_t session = 0;
};

/// The answers of a saved map to queries by name: its layer "places". It is computed from the other data whenever a map
/// is saved, so a run that continues the map does not load it.
struct Places {
  static constexpr char kLayer[] = "places";
  static constexpr std::uint32_t kLayerVersion = 2;

  std::vector<Place> places;  ///< in the order of ids
  std::optional<LastPose> last_pose;

  std::string toBytes() const;
  /// Throws Error(unreadable_input) if the section is another one, of a later version or damaged, if a number is not
  /// finite, or if a direction is not a unit vector.
  static Places fromSection(const MapSection& section);
};

}  // namespace omnimapper::map
