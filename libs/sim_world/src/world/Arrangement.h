#pragma once

#include <omnimapper/sim_world/Building.h>
#include <omnimapper/sim_world/Furniture.h>
#include <omnimapper/sim_world/Generators.h>
#include <omnimapper/sim_world/Random.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// Where along a wall a piece is tried first.
enum class Along { corner, middle, anywhere };

/// Furnishes rooms as people do: along walls, around tables, with free floor before doors and fronts, and a path for a
/// robot through every room. Pieces that do not fit are left out. Rooms and openings are added first; raise() then
/// builds them.
class Arrangement {
 public:
  Arrangement(const WorldOptions& options, const std::string& file);

  WorldPlan plan;
  Random random;
  ClutterLevel clutter;

  RoomPlan& room(const std::string& name, const std::string& kind, const Eigen::Vector2d& low,
                 const Eigen::Vector2d& high);
  OpeningPlan& opening(OpeningPlan::Kind kind, const std::string& first, const std::string& second,
                       const Eigen::Vector2d& near);
  /// A window in an outer wall.
  void window(const std::string& room, const Eigen::Vector2d& near, double width = 1.4);
  void raise();
  const Building& building() const { return building_; }
  bool has(const std::string& room) const;
  const Room& roomNamed(const std::string& name) const;

  /// Puts a piece with its back to a wall, `clear` of floor before its front kept free. Returns its number in
  /// plan.furniture, or nothing if there is no place left.
  std::optional<std::size_t> alongWall(const std::string& room, const std::string& shape, Along along = Along::anywhere,
                                       double clear = 0.6, FurniturePlan sized = {});
  /// Puts a piece as near to the middle of the room as it fits, give or take `spread` [m], turned by a multiple of 90
  /// deg.
  std::optional<std::size_t> inMiddle(const std::string& room, const std::string& shape, FurniturePlan sized = {},
                                      double spread = 0.4);
  /// Puts a piece at a point in the frame of another one, turned by `turn` against it.
  std::optional<std::size_t> beside(std::size_t piece, const std::string& shape, const Eigen::Vector2d& in_piece,
                                    double turn, FurniturePlan sized = {});
  /// Puts a piece exactly where it says, if it fits.
  std::optional<std::size_t> place(FurniturePlan piece, double clear = 0);
  /// Puts up to `count` chairs on the long sides of a table, moved and turned a little.
  void chairsAround(std::size_t table, const std::string& shape, int count);

  /// Spreads up to `count` objects of these shapes at random on a level surface of a piece, its `part`.
  void objectsOn(std::size_t piece, const std::string& part, int count, const std::vector<std::string>& shapes);
  /// Lets a share of the objects be carried to other surfaces at the options' move_time.
  void carryObjects(double share);
  /// Puts groups of objects on the surfaces given to objectsOn() and on further boards of shelves: single ones, thin
  /// ones among them, pairs that touch, and stacks. To be called after everything else.
  void crowdSurfaces(double per_square_metre);
  /// A free place for an item with these extents on one of the surfaces given to objectsOn(), in rooms whose names
  /// begin with `rooms`; it is taken from then on.
  std::optional<PlacePlan> freePlace(const std::string& rooms, const Eigen::Vector2d& reach);
  /// Puts piles of boxes and other clutter along walls: `per_square_metre` of them at level medium, fewer or more at
  /// the others.
  void scatter(const std::string& room, double per_square_metre);

  /// Puts the sign of `room` on the wall of `from` beside the opening.
  void signBeside(const OpeningPlan& door, const std::string& from, const std::string& room,
                  const std::vector<std::string>& lines = {});
  /// The first free place of this size on the walls of a room from `share` of its circumference on; it is taken from
  /// then on.
  std::optional<OnWallPlan> freeWall(const std::string& room, double share, double z, double width, double height);
  /// Puts up to `count` posters and notices on the walls of a room.
  void postersIn(const std::string& room, int count);
  /// Gives `count` signs of doors to rooms that do not exist, evenly spread, one of three words. To be called after
  /// signBeside().
  void repeatSigns(int count);
  /// Puts an exit sign on the wall that each corridor leads up to, through passages on its axis, clockwise around the
  /// building.
  void exitSigns();
  /// Puts up to `count` posters with numbers on the walls of corridors, in turn.
  void announcements(int count);

 private:
  bool fits(const Footprint& footprint, const Ring& clear, const Room& room) const;
  bool keepsPathsOpen(const Footprint& footprint, const Room& room) const;
  std::size_t accept(FurniturePlan piece, const Footprint& footprint, const Ring& clear);
  std::string newName(const std::string& shape);

  bool hidesOpening(const Eigen::Vector2d& at_wall, const Eigen::Vector2d& direction, const Eigen::Vector2d& inward,
                    const FurniturePlan& piece) const;
  std::optional<OnWallPlan> hang(const WallFace& wall, double u, double z, double width, double height);
  std::vector<const Room*> corridors() const;
  void exitSignAhead(const Eigen::Vector2d& from, const Eigen::Vector2d& direction);

  struct Top {
    std::string surface, room;
    Ring usable_in_map;
    double yaw;
    std::vector<Ring> taken;
    double headroom;  ///< height of the free space above it [m]
  };
  std::optional<PlacePlan> freePlace(Top& top, const Eigen::Vector2d& reach);
  /// The level surface of a piece on which objects are put; it is added if it has not been used yet.
  Top& topOf(const FurniturePlan& piece, const std::string& part);
  /// Puts one group of objects on a surface if there is room for it.
  void crowd(Top& top);

  WorldOptions options_;
  Building building_;
  std::vector<Footprint> taken_;
  std::vector<Ring> doorways_;  ///< nothing stands there
  std::vector<Ring> fronts_;    ///< nothing but chairs stands there
  std::vector<Top> tops_;
  std::vector<Footprint> hung_;
  std::map<std::string, int> counts_;
};

/// Number of boards of a shelf or rack; 0 for other furniture.
int boardsOf(const FurniturePlan& piece);

}  // namespace omnimapper::sim
