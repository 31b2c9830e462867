#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// The plans as an INI gives them: values that are neither numbers nor single words are lists of words here.

struct RoomIni : RoomPlan {
  std::vector<std::string> rectangle_words, outline_words;
  static const base::OptionTable<RoomIni>& table();
};
struct OpeningIni : OpeningPlan {
  static const base::OptionTable<OpeningIni>& table();
};
struct FurnitureIni : FurniturePlan {
  static const base::OptionTable<FurnitureIni>& table();
};
/// Members of parts of a plan are copied here, since a table takes members of the struct itself.
struct PlaceIni {
  double x = 0, y = 0, yaw = 0;
  std::string on;
  std::vector<std::string> move_words;
};
struct ObjectIni : ObjectPlan, PlaceIni {
  static const base::OptionTable<ObjectIni>& table();
};
struct OnWallIni {
  double x = 0, y = 0, z = 1.5;
};
struct SignIni : SignPlan, OnWallIni {
  std::string text;
  static const base::OptionTable<SignIni>& table();
};
struct PosterIni : PosterPlan, OnWallIni {
  static const base::OptionTable<PosterIni>& table();
};
struct MarkerIni : MarkerPlan, PlaceIni {
  double z = 1.5;
  static const base::OptionTable<MarkerIni>& table();
};
struct LandmarkIni : LandmarkPlan {
  static const base::OptionTable<LandmarkIni>& table();
};

struct CompanionIni : CompanionPlan {
  static const base::OptionTable<CompanionIni>& table();
};
struct PersonIni {
  double height = 1.72, yaw = 0;
  std::vector<std::string> path_words, pointing_words, carrying_words;
  static const base::OptionTable<PersonIni>& table();
};

}  // namespace omnimapper::sim
