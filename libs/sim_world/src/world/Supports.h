#pragma once

#include <omnimapper/sim_world/Body.h>
#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/ObjectMaking.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// A level surface on which items stand.
struct Support {
  std::string name;     ///< "table_1/top"
  std::string carrier;  ///< the body that it is a part of
  bool is_of_object = false;
  std::vector<Eigen::Vector3d> outline_in_carrier;  ///< [m]
  Track map_from_carrier;

  struct Level {
    Ring outline_in_map;
    double z = 0;  ///< [m]
  };
  /// None while the carrier is away.
  std::optional<Level> at(double time) const;
};

/// The level surfaces of furniture and of objects.
class Supports {
 public:
  /// Adds all level surfaces of a piece of furniture that face upwards.
  void addFurniture(const Body& furniture);
  void addObject(const std::string& name, const LevelTop& top, const Track& track);

  /// The surface of this name, or null.
  const Support* find(const std::string& name) const;
  std::vector<std::string> names() const;
  /// Whether any part of the furniture of this name reaches into a space. Touching it from outside does not count.
  bool reachesInto(const std::string& furniture, const Footprint& space) const;

 private:
  using Corners = std::array<Eigen::Vector3d, 3>;
  std::map<std::string, Support> supports_;
  std::map<std::string, std::vector<Corners>> triangles_in_map_;  // of furniture that has level surfaces, by its name
};

}  // namespace omnimapper::sim
