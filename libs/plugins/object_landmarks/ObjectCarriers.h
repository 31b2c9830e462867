#pragma once

#include <omnimapper/plugin/State.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "KnownObject.h"

namespace omnimapper::plugins {

/// The level surfaces of a map, on which its objects may stand: those of other plugins' landmarks, such as tables, and
/// the tops of the objects' boxes.
class ObjectCarriers {
 public:
  /// `owner`: INI section of the objects. Which way is up is taken from the layer "level", else it is the map's z.
  ObjectCarriers(const ObjectIndex& objects, const mapper::State& state);

  /// The surface within 5 cm of the height of the object's base: the one beneath its middle, or else the nearest at
  /// most 0.5 m beside what was seen of it, because things on a surface hide a part. None if there is no such surface.
  std::optional<base::LandmarkId> under(base::LandmarkId object, const map::Box& box) const;
  /// [m] The height of a box's base above the highest surface of another plugin below it, 0 if it is at most 5 cm above
  /// or beneath one; none if there is no such surface.
  std::optional<double> heightOf(const map::Box& box) const;
  /// Whether an object of which no image shows the surface below it stands on a table or another surface of the map
  /// that was seen from elsewhere: its base is within 5 cm of the surface, and its middle above what was seen of it or
  /// at most 0.1 m beside. The floor is none, because images of a thing on it show it.
  bool bear(const map::Box& box) const;
  /// The surface of another plugin that this box holds up: it ends within 6 cm of the height of the surface, at most
  /// 0.5 m beside what was seen of it, and begins at least 0.25 m lower. So ends a leg of a table, whose top was seen
  /// only in part. None if there is no such surface.
  std::optional<base::LandmarkId> heldUpBy(const map::Box& box) const;

 private:
  struct Surface {
    base::LandmarkId landmark;
    std::vector<geometry::Polygon3> outlines;  // level, in the map [m]
    bool is_object = false, is_floor = false;
  };
  Eigen::Vector3d up_;
  std::vector<Surface> surfaces_;
};

}  // namespace omnimapper::plugins
