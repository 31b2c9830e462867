#pragma once

#include <omnimapper/sim_world/Building.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <limits>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// The floor and the level surfaces of furniture, and what stands on them at which time.
class StandingSpace {
 public:
  StandingSpace(const WorldPlan& plan, const Building& building);

  /// Takes the place of a piece of furniture and returns its frame. Throws base::Error naming its section unless it is
  /// within one room and overlaps nothing else.
  geometry::Se3 put(const FurniturePlan& sized, bool follows_slope);
  /// Lets objects stand on the level surfaces of this body from now on.
  void addSupports(const Body& body);

  /// Takes the places of an object over time and returns its track. `extents` are along the object's own axes; the
  /// origin of its frame is in the middle of its lowest face. Throws base::Error naming section `name` unless moves are
  /// in order of time and the object stands wholly on its support wherever it is put, overlapping nothing that stands
  /// there at that time.
  Track trackOf(const std::string& name, const PlacePlan& place, const std::vector<MovePlan>& moves,
                const Eigen::Vector3d& extents);
  /// Throws base::Error naming the person's section if its path leads through a wall or through something that stands
  /// there at that time.
  void refuseBlockedPath(const PersonSpec& person) const;

 private:
  struct Support {
    std::string name;
    Ring outline_in_map;
    double z;
  };
  geometry::Se3 poseOf(const std::string& name, const std::string& key, const PlacePlan& place,
                       const Eigen::Vector3d& extents) const;
  /// A footprint and the time in which it is taken [s].
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

/// The space that a piece of furniture fills. Chairs fit under tables.
Footprint footprintOf(const FurniturePlan& sized, double floor_z);

}  // namespace omnimapper::sim
