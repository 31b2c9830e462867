#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/sim_world/World.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <string>
#include <utility>
#include <vector>

namespace omnimapper::sim {

enum class ClutterLevel { low, medium, high };
enum class ObjectClutter { none, low, medium, high };

/// People who accompany the robot without sections of their own.
enum class CompanionGroup {
  none,
  guide,   ///< one who leads the robot
  guests,  ///< one beside and one behind it
  group,   ///< five who hide the walls ahead and on both sides
  crowd,   ///< the group, one behind, and one who crosses the path
};

/// Section [world] of an INI: what a generator makes, and what sections add to it.
struct WorldOptions {
  int seed = 1;
  int plan_seed = 0;               ///< seed of the rooms and openings that the generator makes; 0: its fixed plan
  std::string generator = "none";  ///< one of generatorNames()
  ClutterLevel clutter = ClutterLevel::medium;
  ObjectClutter object_clutter = ObjectClutter::none;
  double length = 200;    ///< of a loop of corridor, along its middle [m]
  double move_time = 90;  ///< time at which moveable objects are carried elsewhere; negative: never [s]
  double wear = 0;  ///< standard deviation of the brightness of static surfaces, divided by its mean; see World::wear
  std::string sign_style = "dark";
  int repeated_signs = 0;  ///< number of additional door signs that say a repeated word, such as Storage
  bool exit_signs = false;
  int announcements = 0;  ///< largest number of posters with numbers in the corridors of the place
  CompanionGroup companions = CompanionGroup::none;
  std::string hall_wall;  ///< material of the walls of the corridors; empty: the generator's
  std::vector<std::string> rooms, doors, furniture, objects, signs, posters, markers, landmarks, people;
  static const base::OptionTable<WorldOptions>& table();
};

/// Reads [world] and all sections it names. Throws base::Error unknown_key, wrong_type, out_of_range or unknown_plugin
/// with file, section and key.
WorldPlan readWorldPlan(const base::Config& config);
/// The world that makeWorld() builds from readWorldPlan().
World readWorld(const base::Config& config);

/// For the reference of keys: each kind of section that [world] may name, with its classes and options. A list whose
/// classes have different options is there once for each class.
struct WorldSectionReference {
  std::string list;                       ///< key of [world] that names such sections
  std::vector<std::string> class_names;   ///< what its key `class` may be
  std::vector<base::OptionSpec> options;  ///< without `class`
};
std::vector<WorldSectionReference> worldSectionReferences();

}  // namespace omnimapper::sim
