#pragma once

#include "Arrangement.h"

namespace omnimapper::sim {

/// Each generator fills an arrangement, rooms first. Sizes are those of places where people live and work. Home, office
/// and laboratory draw sizes, doors and rooms of their plan if options.plan_seed is above 0 (PlanVariation).

/// 6 x 7 m, four walls, point landmarks along them and inside (thesis 4.5.2.4).
void makeBox(Arrangement& place, const WorldOptions& options);
/// Living room, kitchen, hallway, bedroom, bathroom, study (thesis 5.5.2.2).
void makeHome(Arrangement& place, const WorldOptions& options);
/// Corridors around cubicles and an atrium: two loops that overlap (thesis 5.5.2.2).
void makeOffice(Arrangement& place, const WorldOptions& options);
/// A large cluttered laboratory in a loop of narrow hallways (thesis 5.5.2.2).
void makeLaboratory(Arrangement& place, const WorldOptions& options);
/// Two offices of 4.5 m and 12 m of corridor between their doors; 12, 9 and 8 markers on walls, 10 in frames that are
/// carried from the first office to the second (thesis 4.6.3).
void makeTwoOffices(Arrangement& place, const WorldOptions& options);
/// A ring of corridor with doors and signs; a cluttered laboratory is part of it, an atrium and a kitchen too if it is
/// long (thesis 5.5.3).
void makeLoop(Arrangement& place, const WorldOptions& options);
/// A wide ring of corridor without rooms, for a 3D laser.
void makeCorridorLoop(Arrangement& place, const WorldOptions& options);
/// A street that climbs a hill, with kerbs, houses, cars and trees.
void makeRoad(Arrangement& place, const WorldOptions& options);

/// Functions that several generators use.
void furnishOffice(Arrangement& place, const std::string& room, int desks);
void furnishKitchenette(Arrangement& place, const std::string& room);
void furnishLaboratory(Arrangement& place, const std::string& room);
/// Adds closed doors to rooms that do not exist on both sides of a straight corridor, about `spacing` apart [m].
void addDoorsAlong(Arrangement& place, const std::string& corridor, double spacing, int& number);
/// Adds signs of all doors of addDoorsAlong() and of doors between a corridor and a room. To be called after raise().
void addSigns(Arrangement& place);

}  // namespace omnimapper::sim
