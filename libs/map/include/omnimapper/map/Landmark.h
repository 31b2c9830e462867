#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/geometry/Polygon3.h>
#include <omnimapper/map/Property.h>

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace omnimapper::map {

class KeyFrames;

/// A small picture of something. `rgb`: red, green, blue of each pixel, row by row from the top.
struct Photograph {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// A box along axes of its own.
struct Box {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();                  ///< [m] in the map
  Eigen::Quaterniond map_from_box = Eigen::Quaterniond::Identity();  ///< unit
  Eigen::Vector3d size = Eigen::Vector3d::Zero();                    ///< [m] of its sides, positive

  /// The corners in the map [m]: bit i of the index says on which side of axis i a corner is.
  std::array<Eigen::Vector3d, 8> corners() const;
};

/// Triangles in space; their corners are counter-clockwise as seen from outside.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;                ///< [m] in the map
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of vertices
};

/// The shape of a landmark, for drawing and export. All geometry is in the frame of the map [m].
struct LandmarkShape {
  std::string label;                         ///< what a user calls it: "wall", "table", "sign"
  std::string caption;                       ///< what is written beside it in drawings: a sign's text; may be empty
  std::string reason;                        ///< why it has this label; may be empty
  bool is_candidate = false;                 ///< not drawn: seen too rarely or too rough
  std::vector<geometry::Polygon3> surfaces;  ///< flat, each may be concave
  std::vector<geometry::Polygon3> holes;     ///< each is cut out of one of `surfaces` (holesIn())
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> lines;  ///< from, to
  std::vector<Eigen::Vector3d> points;
  std::optional<Box> box;                        ///< around a thing that has no flat surfaces of its own
  std::shared_ptr<const Mesh> mesh;              ///< its surface; null if it has none
  std::vector<base::Stamp> point_stamps;         ///< when the landmark was at each of `points`; empty: at all times
  std::optional<Eigen::Vector3d> normal;         ///< unit, points to the free side
  std::shared_ptr<const Photograph> photograph;  ///< a camera's image of the landmark; null if there is none
  std::vector<Property> properties;              ///< whatever else is known: for tables, exports and searches
  std::map<std::string, std::uint64_t> seen_by;  ///< number of measurements by sensor label, as far as it is known

  /// Counts measurements of the sensor of that label; one without a label is called "no_label".
  void addSeenBy(const std::string& label, std::uint64_t measurements) {
    seen_by[label.empty() ? "no_label" : label] += measurements;
  }
};

/// The holes of a surface of the shape. A hole belongs to the smallest surface around it, because an island may lie in
/// a hole and have holes itself.
std::vector<geometry::Polygon3> holesIn(const LandmarkShape& shape, std::size_t surface);

/// The part of a landmark that is not optimized: a plane's extent, a sign's text, an object's model. A payload is
/// immutable; a plugin that learns more makes a new payload. Points in a payload are in the base frame of the key frame
/// that saw them.
class LandmarkPayload {
 public:
  virtual ~LandmarkPayload() = default;
  /// Name of this kind of payload in files, unique among kinds. The reader of the kind is registered under this name.
  virtual std::string_view kind() const = 0;
  virtual void write(std::ostream& out) const = 0;
  /// Whether a landmark with this payload may have variables of these kinds, in this order. A map with a landmark for
  /// which this is false is damaged.
  virtual bool fits(const std::vector<std::string_view>& /*kinds*/) const { return true; }
  /// The key frames that the payload refers to. A map that lacks one of these key frames is damaged.
  virtual std::vector<base::KeyFrameId> keyFrames() const { return {}; }
  /// The payload as these key frames alone saw the landmark. Null if that would be the same payload, or if nothing
  /// would be left of it.
  virtual std::shared_ptr<const LandmarkPayload> seenFrom(const std::set<base::KeyFrameId>& /*frames*/) const {
    return nullptr;
  }
  /// `values`: the values of the landmark's variables, in the order of the variables. Empty if the landmark has no
  /// variables, or if one of them was removed.
  virtual LandmarkShape shape(const std::vector<Eigen::VectorXd>& /*values*/, const KeyFrames& /*key_frames*/) const {
    return {};
  }
};

/// Something in the environment that was seen and may be seen again (thesis 4).
struct Landmark {
  enum class State : std::uint8_t {
    active,
    retired,  ///< no longer there: kept with its factors, but nothing is associated with it any more
    merged,   ///< found to be the same as another landmark, which has its factors now
  };
  base::LandmarkId id;
  std::string kind;   ///< "wall", "door sign", ...: what a user calls it
  std::string owner;  ///< INI section of the plugin that made it
  std::vector<base::VariableId> variables;
  std::shared_ptr<const LandmarkPayload> payload;  ///< null if there are no data beside the variables
  std::uint32_t evidence = 0;                      ///< number of times it was measured
  base::Stamp first_seen, last_seen;
  State state = State::active;
  base::LandmarkId merged_into;  ///< while state is merged
};

}  // namespace omnimapper::map
