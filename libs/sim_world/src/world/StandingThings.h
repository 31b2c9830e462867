#pragma once

#include <omnimapper/sim_world/Building.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <limits>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// The floor and the level surfaces of furniture, and what stands on them when.
class StandingSpace {
 public:
  StandingSpace(const WorldPlan& plan, const Building& building);

  /// Takes the place of a piece of furniture. Throws base::Error naming its section unless it is in one room and in
  /// nothing else. Returns its frame.
  geometry::Se3 put(const FurniturePlan& sized, bool follows_slope);
  /// From now on things can stand on the level surfaces of this body.
  void addSupports(const Body& body);

  /// Where a thing with these extents along its own x and y is over time, its frame's origin in the middle of its
  /// lowest face. Throws base::Error naming section `name` unless moves are in order and it stands wherever it is put,
  /// whole, and in nothing that stands there then.
  Track trackOf(const std::string& name, const PlacePlan& place, const std::vector<MovePlan>& moves,
                const Eigen::Vector3d& extents);
  /// Throws base::Error naming the person's section if its way leads through a wall or through what stands there then.
  void refuseBlockedWay(const PersonSpec& person) const;

 private:
  struct Support {
    std::string name;
    Ring outline_in_map;
    double z;
  };
  geometry::Se3 poseOf(const std::string& name, const std::string& key, const PlacePlan& place,
                       const Eigen::Vector3d& extents) const;
  /// A footprint and the time in which it is filled [s].
  struct Taken {
    Footprint footprint;
    double begin = -std::numeric_limits<double>::infinity(), end = std::numeric_limits<double>::infinity();
  };
  void take(const std::string& name, const std::string& key, Taken taken, const std::string& support);
  void refuseBlocked(const std::string& person, const std::string& stretch, const Taken& swept) const;

  const WorldPlan& plan_;
  const Building& building_;
  std::vector<Taken> taken_;
  std::vector<Support> supports_;
};

/// What a piece of furniture fills: people push chairs under tables.
Footprint footprintOf(const FurniturePlan& sized, double floor_z);

}  // namespace omnimapper::sim
