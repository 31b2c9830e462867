#pragma once

#include <omnimapper/sim_world/Random.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// Turns the fixed plan of a generator into one that is drawn by [world] plan_seed. Rooms are rectangles along the axes
/// that were added with Arrangement::room(). The generator first names rooms that may be left out or reversed, then
/// redraw() draws sizes and openings. The drawn plan depends on plan_seed alone.
class PlanVariation {
 public:
  PlanVariation(WorldPlan& plan, int plan_seed);

  bool chance(double probability) { return random_.chance(probability); }
  /// Leaves a room out with this probability, and its openings with it.
  void maybeLeaveOut(const std::string& room, double probability);
  /// Leaves out all that lies beyond this x, and cuts rooms off there [m].
  void cutOffBeyond(double x);
  /// With probability 1/2 reverses a row of rooms, with its openings, about this x [m]. An opening moves if its first
  /// room is in the row.
  void maybeReverseRow(const std::vector<std::string>& rooms, double middle_x);

  /// Draws the rest: width and depth of each room but corridors are 80 to 130 % of what they were, corridors are 1.5 to
  /// 2.4 m wide, walls between rooms are 0.08 to 0.24 m thick, and ceilings are 2.4 to 3 m high (those above 3 m change
  /// by the same factor as the others). Every opening gets a new place in its wall, and the plan is mirrored in x, in
  /// y, in both or not at all. A closed door to the outside that now faces a room is left out.
  void redraw();

 private:
  /// Coordinates along one axis of the lines of the fixed plan (`from`) and of the same lines in the drawn one (`to`)
  /// [m].
  struct Axis {
    std::vector<double> from, to;
    double at(double coordinate) const;
  };

  RoomPlan& roomNamed(const std::string& name);
  bool has(const std::string& room) const;
  void removeOpeningsWithoutRooms();
  Axis drawAxis(int axis);
  void redrawHeights();

  WorldPlan& plan_;
  Random random_;
  double wall_factor_ = 1;
};

}  // namespace omnimapper::sim
