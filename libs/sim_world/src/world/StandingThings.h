#pragma once

#include <omnimapper/sim_world/Building.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <limits>
#include <string>
#include <vector>

#include "ItemSpace.h"
#include "Supports.h"

namespace omnimapper::sim {

/// Something that is put on the floor, on furniture or on an object, as its section describes it.
struct Item {
  std::string name;  ///< of its section
  PlacePlan place;
  std::vector<MovePlan> moves;
  ItemSpace space;
  std::string touching = {};  ///< the item that it is slid against at the start, or empty
};

/// The floor and the level surfaces of furniture and objects, and what stands on them at which time.
class StandingSpace {
 public:
  StandingSpace(const WorldPlan& plan, const Building& building);

  /// Takes the place of a piece of furniture and returns its frame. Throws base::Error naming its section unless it is
  /// within one room and overlaps nothing else.
  geometry::Se3 put(const FurniturePlan& sized, bool follows_slope);
  /// Lets items stand on the level surfaces of this body from now on.
  void addFurnitureTops(const Body& furniture) { supports_.addFurniture(furniture); }
  /// Lets items stand on this object from now on. If the object is moved, they go with it.
  void addObjectTop(const std::string& name, const LevelTop& top, const Track& track) {
    supports_.addObject(name, top, track);
  }

  /// Takes the places of an item over time and returns its track. Throws base::Error naming the item's section unless
  /// moves are in order of time and the item stands on its support wherever it is put, overlapping nothing that stands
  /// there at that time: on furniture with its whole outline, on an object with its foot.
  Track trackOf(const Item& item);
  /// Names of the items that stand on an item just before `time`, directly or on one another.
  std::vector<std::string> ridersOf(const std::string& item, double time) const;
  /// Throws base::Error naming the person's section if its path leads through a wall or through something that stands
  /// there at that time.
  void refuseBlockedPath(const PersonSpec& person) const;

 private:
  /// A stretch of time [s] in which an item is at one place; null: it is away. Section and key are its place in the
  /// INI.
  struct Stage {
    double begin = 0, end = std::numeric_limits<double>::infinity();
    const PlacePlan* place = nullptr;
    std::string section, key;
  };
  /// A footprint and the time in which it is taken [s].
  struct Taken {
    Footprint footprint;
    double begin = -std::numeric_limits<double>::infinity(), end = std::numeric_limits<double>::infinity();
    std::string on = {};  // the support; empty: the floor
    Eigen::Vector2d middle = {0, 0};
  };
  std::vector<Stage> stagesOf(const Item& item) const;
  /// Where an item stands in a stage: at several places one after the other if its carrier is moved meanwhile.
  std::vector<Track::Place> placesIn(const Stage& stage, const Item& item) const;
  geometry::Se3 poseOnFloor(const Stage& stage, const Item& item) const;
  geometry::Se3 poseOnSupport(const Stage& stage, const Item& item, const Support& support) const;
  const Support& supportOf(const Stage& stage, const Item& item) const;
  PlacePlan slidAgainst(const Item& item) const;
  void takeStage(const Stage& stage, const Item& item, const std::vector<Track::Place>& places);
  void take(const Stage& stage, Taken taken);
  /// The bodies that carry what stands on a support, from the support's own body down.
  std::vector<std::string> carriersOf(const std::string& support, double time) const;
  const Taken* takenBy(const std::string& name, double time) const;
  void refuseBlocked(const std::string& person, const std::string& stretch, const Taken& swept) const;

  const WorldPlan& plan_;
  const Building& building_;
  std::vector<Taken> taken_;
  Supports supports_;
};

/// The space that a piece of furniture fills. Chairs fit under tables.
Footprint footprintOf(const FurniturePlan& sized, double floor_z);

}  // namespace omnimapper::sim
