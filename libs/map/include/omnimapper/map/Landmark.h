#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/geometry/Polygon3.h>

#include <Eigen/Core>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace omnimapper::map {

class KeyFrames;

/// The property that tells how often the sensor of that label saw a landmark.
inline std::string seenByKey(const std::string& label) {
  return "seen_by_" + (label.empty() ? "no_label" : label);
}

/// A small picture of something. `rgb`: red, green, blue of each pixel, row by row from the top.
struct Photograph {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// How a landmark looks in the map, for whoever draws or exports it. All in the frame of the map [m].
struct LandmarkShape {
  std::string label;                         ///< what a user calls it: "wall", "table", "sign"
  std::string caption;                       ///< what is written beside it in drawings: a sign's text; may be empty
  std::string reason;                        ///< why it is called so; may be empty
  bool is_candidate = false;                 ///< seen too little to be drawn
  std::vector<geometry::Polygon3> surfaces;  ///< flat, each may be concave
  std::vector<geometry::Polygon3> holes;     ///< each in one of `surfaces`, which it is cut out of (holesIn())
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> lines;  ///< from, to
  std::vector<Eigen::Vector3d> points;
  std::vector<base::Stamp> point_stamps;         ///< when it was at each of `points`; empty: at all times
  std::optional<Eigen::Vector3d> normal;         ///< unit, to the free side
  std::shared_ptr<const Photograph> photograph;  ///< as a camera saw it; null for none
  std::vector<std::pair<std::string, std::string>> properties;  ///< name with unit, value: for tables and exports
  /// Of the properties, that of seenByKey() tells how often a sensor saw it.
};

/// The holes of a surface of the shape: of those that go around a hole it is the smallest, for an island may lie in a
/// hole and have holes itself.
std::vector<geometry::Polygon3> holesIn(const LandmarkShape& shape, std::size_t surface);

/// What a landmark is beside what is optimised: a plane's extent, a sign's text, an object's model. Immutable; a plugin
/// that learns more gives a new one. Points in it are in the base of the key frame that saw them.
class LandmarkPayload {
 public:
  virtual ~LandmarkPayload() = default;
  /// Name in files, unique among payloads: its reader is registered under it.
  virtual std::string_view kind() const = 0;
  virtual void write(std::ostream& out) const = 0;
  /// Whether a landmark with this payload may have variables of these kinds, in this order.
  virtual bool fits(const std::vector<std::string_view>& /*kinds*/) const { return true; }
  /// The key frames that it refers to. A map that lacks one of them, or whose variables do not fit, is damaged.
  virtual std::vector<base::KeyFrameId> keyFrames() const { return {}; }
  /// The same landmark as only these key frames saw it; null where that makes no difference or nothing is left of it.
  virtual std::shared_ptr<const LandmarkPayload> seenFrom(const std::set<base::KeyFrameId>& /*frames*/) const {
    return nullptr;
  }
  /// `values`: those of the landmark's variables, in their order; none if it has none or they are gone.
  virtual LandmarkShape shape(const std::vector<Eigen::VectorXd>& /*values*/, const KeyFrames& /*key_frames*/) const {
    return {};
  }
};

/// Something in the place that was seen, and may be seen again (thesis 4).
struct Landmark {
  enum class State : std::uint8_t {
    active,
    retired,  ///< no longer there: kept with its factors, but nothing is associated with it any more
    merged,   ///< found to be another one, which has its factors now
  };
  base::LandmarkId id;
  std::string kind;   ///< "wall", "door sign", ...: what a user calls it
  std::string owner;  ///< INI section of the plugin that knows it
  std::vector<base::VariableId> variables;
  std::shared_ptr<const LandmarkPayload> payload;  ///< null if there is nothing beside the variables
  std::uint32_t evidence = 0;                      ///< observations counted for it
  base::Stamp first_seen, last_seen;
  State state = State::active;
  base::LandmarkId merged_into;  ///< while state is merged
};

}  // namespace omnimapper::map
