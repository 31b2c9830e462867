#pragma once

#include <omnimapper/sim/Building.h>
#include <omnimapper/sim/WorldPlan.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// The floor and the level surfaces of furniture, and what stands on them at the start.
class StandingSpace {
 public:
  StandingSpace(const WorldPlan& plan, const Building& building);

  /// Takes the place of a piece of furniture. Throws base::Error naming its section unless it is in one room and in
  /// nothing else. Returns its frame.
  geometry::Se3 put(const FurniturePlan& sized, bool follows_slope);
  /// From now on things can stand on the level surfaces of this body.
  void addSupports(const Body& body);

  /// Where a thing with these extents along its own x and y is over time, its frame's origin in the middle of its
  /// lowest face. Throws base::Error naming section `name` unless it stands where it is put, whole, and moves are in
  /// order.
  Track trackOf(const std::string& name, const PlacePlan& place, const std::vector<MovePlan>& moves,
                const Eigen::Vector3d& extents);

 private:
  struct Support {
    std::string name;
    Ring outline_in_map;
    double z;
  };
  geometry::Se3 poseOf(const std::string& name, const std::string& key, const PlacePlan& place,
                       const Eigen::Vector3d& extents) const;
  void take(const std::string& name, Footprint footprint, const std::string& support);

  const WorldPlan& plan_;
  const Building& building_;
  std::vector<Footprint> taken_;
  std::vector<Support> supports_;
};

/// What a piece of furniture fills: people push chairs under tables.
Footprint footprintOf(const FurniturePlan& sized, double floor_z);

}  // namespace omnimapper::sim
