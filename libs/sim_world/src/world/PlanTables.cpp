#include "PlanTables.h"

#include <omnimapper/sim_world/WorldIni.h>

namespace omnimapper::sim {

using base::OptionTable;
using base::Range;

namespace {

constexpr Range kAnywhere{};
constexpr Range kSize{0, 100}, kSizeOnWall{0, 5};  // [m]

// What stands somewhere, and is carried elsewhere.
template <class Ini>
void addPlace(OptionTable<Ini>& table) {
  table.number("x_m", &Ini::x, kAnywhere, "Where its middle is in the map.")
      .number("y_m", &Ini::y, kAnywhere, "The same along y.")
      .number("yaw_deg", &Ini::yaw, kAnywhere, "How it is turned; at 0 its front looks to -y.")
      .text("on", &Ini::on, "Level surface it stands on, such as table_1/top; empty: the floor.")
      .list("moves", &Ini::move_words,
            "Where it is carried: 'time x y yaw [on]' or 'time away', in s, m and deg, groups separated by |.");
}

template <class Ini>
void addOnWall(OptionTable<Ini>& table) {
  table.number("x_m", &Ini::x, kAnywhere, "A point in the room, at most 0.5 m from the wall it hangs on.")
      .number("y_m", &Ini::y, kAnywhere, "The same along y.")
      .number("z_m", &Ini::z, Range::positive(), "Height of its middle above the floor.");
}

template <class Ini>
void addSize(OptionTable<Ini>& table) {
  table.number("length_m", &Ini::length, kSize, "Along its front; 0: as is usual.")
      .number("width_m", &Ini::width, kSize, "From front to back; 0: as is usual.")
      .number("height_m", &Ini::height, kSize, "0: as is usual.");
}

}  // namespace

const OptionTable<WorldOptions>& WorldOptions::table() {
  static const auto table =
      OptionTable<WorldOptions>()
          .integer("seed", &WorldOptions::seed, Range::notNegative(), "Of everything that is drawn by chance.")
          .text("generator", &WorldOptions::generator,
                "Makes a whole place: none, home, office, laboratory, two_offices, loop, corridor_loop, box or road.")
          .integer("plan_seed", &WorldOptions::plan_seed, Range::notNegative(),
                   "Of rooms, doors, windows and ceilings of a home, an office or a laboratory; 0: the fixed plan, the "
                   "only one of other places.")
          .choice("clutter", &WorldOptions::clutter,
                  {{"low", ClutterLevel::low}, {"medium", ClutterLevel::medium}, {"high", ClutterLevel::high}},
                  "How much stands about in a generated place.")
          .number("length_m", &WorldOptions::length, {24, 1000},
                  "Of a generated loop, along the middle of its corridor.")
          .number("move_time_s", &WorldOptions::move_time, kAnywhere,
                  "When moveable things of a generated place are carried elsewhere; negative: never.")
          .number(
              "wear", &WorldOptions::wear, {0, 0.3},
              "How much the brightness of what stands still varies by stains, scuffs and grain that repeat nowhere: "
              "its standard deviation over its mean. 0: all is new, and a wall shows a camera next to nothing.")
          .choice("sign_style", &WorldOptions::sign_style, {{"dark", "dark"}, {"white", "white"}},
                  "Building style of a generated place: look of its door signs, and how high they hang.")
          .integer("repeated_signs", &WorldOptions::repeated_signs, {0, 1000},
                   "How many door signs of a generated place bear no number but one of three words: Storage, Women, "
                   "Men. The doors are those to rooms that are not there.")
          .flag("exit_signs", &WorldOptions::exit_signs,
                "An exit sign hangs on the wall that each corridor of a generated place leads up to, clockwise around "
                "the building.")
          .integer("announcements", &WorldOptions::announcements, {0, 1000},
                   "At most so many posters with numbers hang in the corridors of a generated place, if there is room.")
          .text("hall_wall", &WorldOptions::hall_wall,
                "Material of the walls of corridors of a generated place; empty: as is usual there.")
          .list("rooms", &WorldOptions::rooms, "Sections of rooms.")
          .list("doors", &WorldOptions::doors, "Sections of doors, passages and windows.")
          .list("furniture", &WorldOptions::furniture, "Sections of furniture.")
          .list("objects", &WorldOptions::objects, "Sections of objects.")
          .list("signs", &WorldOptions::signs, "Sections of door signs.")
          .list("posters", &WorldOptions::posters, "Sections of posters and other things on walls.")
          .list("markers", &WorldOptions::markers, "Sections of square markers.")
          .list("landmarks", &WorldOptions::landmarks, "Sections of point landmarks.")
          .list("people", &WorldOptions::people, "Sections of people.");
  return table;
}

const OptionTable<RoomIni>& RoomIni::table() {
  static const auto table =
      OptionTable<RoomIni>()
          .list("rectangle_m", &RoomIni::rectangle_words, "Two opposite corners of its free inside: x y x y.")
          .list("outline_m", &RoomIni::outline_words, "Or all its corners in turn: x y x y x y ...")
          .text("kind", &RoomIni::kind, "What it is used for: kitchen, office, corridor, road, ...")
          .text("number", &RoomIni::number, "Its number, as on door signs.")
          .number("floor_m", &RoomIni::floor_z, {-1000, 1000}, "Height of the floor at its first corner.")
          .number("height_m", &RoomIni::height, {1.8, 100}, "From floor to ceiling.")
          .number("slope_x", &RoomIni::slope_x, {-0.5, 0.5}, "Rise of the floor per metre along x.")
          .number("slope_y", &RoomIni::slope_y, {-0.5, 0.5}, "The same along y.")
          .text("wall", &RoomIni::wall, "Material of its walls.")
          .text("floor", &RoomIni::floor, "Material of its floor.")
          .text("ceiling", &RoomIni::ceiling, "Material of its ceiling.");
  return table;
}

const OptionTable<OpeningIni>& OpeningIni::table() {
  using Leaf = OpeningPlan::Leaf;
  static const auto table =
      OptionTable<OpeningIni>()
          .list("rooms", &OpeningIni::rooms, "The two rooms it joins; the second may be 'outside'.")
          .number("x_m", &OpeningIni::x, kAnywhere, "A point near its middle; the wall nearest to it has the opening.")
          .number("y_m", &OpeningIni::y, kAnywhere, "The same along y.")
          .number("width_m", &OpeningIni::width, Range::notNegative(), "Of the opening; 0: all that both rooms share.")
          .number("height_m", &OpeningIni::height, Range::positive(), "Of the opening itself.")
          .number("sill_m", &OpeningIni::sill, Range::notNegative(), "Height of its bottom above the floor.")
          .choice("leaf", static_cast<Leaf OpeningIni::*>(&OpeningIni::leaf),
                  {{"none", Leaf::none}, {"open", Leaf::open}, {"closed", Leaf::closed}}, "Of a door.")
          .number("leaf_angle_deg", &OpeningIni::leaf_angle, {0, 180},
                  "How far an open leaf is turned into the first room.")
          .flag("hinge_right", &OpeningIni::hinge_right, "Its hinge is on the right, seen from the first room.")
          .text("material", &OpeningIni::material, "Of frame and leaf.");
  return table;
}

const OptionTable<FurnitureIni>& FurnitureIni::table() {
  static const auto table = [] {
    OptionTable<FurnitureIni> result;
    result.number("x_m", &FurnitureIni::x, kAnywhere, "Where its middle is in the map.")
        .number("y_m", &FurnitureIni::y, kAnywhere, "The same along y.")
        .number("z_m", &FurnitureIni::z, Range::notNegative(), "Its lowest point above the floor; 0: as is usual.")
        .number("yaw_deg", &FurnitureIni::yaw, kAnywhere, "How it is turned; at 0 its front looks to -y.");
    addSize(result);
    result.integer("boards", &FurnitureIni::boards, {0, 20}, "Of a shelf; 0: as is usual.")
        .text("material", &FurnitureIni::material, "Empty: as is usual.");
    return result;
  }();
  return table;
}

const OptionTable<ObjectIni>& ObjectIni::table() {
  static const auto table = [] {
    OptionTable<ObjectIni> result;
    addPlace(result);
    addSize(result);
    result.flag("moveable", &ObjectIni::moveable, "Whether people carry it about.");
    return result;
  }();
  return table;
}

const OptionTable<SignIni>& SignIni::table() {
  static const auto table = [] {
    OptionTable<SignIni> result;
    result.text("room", &SignIni::room, "The room it names.")
        .text("text", &SignIni::text, "Its lines, separated by |; empty: number and name of the room.");
    addOnWall(result);
    result.number("width_m", &SignIni::width, kSizeOnWall, "0: as its text needs.")
        .number("height_m", &SignIni::height, kSizeOnWall, "The same.");
    return result;
  }();
  return table;
}

const OptionTable<PosterIni>& PosterIni::table() {
  static const auto table = [] {
    OptionTable<PosterIni> result;
    addOnWall(result);
    result.number("width_m", &PosterIni::width, kSizeOnWall, "0: as is usual.")
        .number("height_m", &PosterIni::height, kSizeOnWall, "The same.");
    return result;
  }();
  return table;
}

const OptionTable<MarkerIni>& MarkerIni::table() {
  static const auto table = [] {
    OptionTable<MarkerIni> result;
    result.integer("id", &MarkerIni::id, Range::notNegative(), "Of its dictionary.")
        .number("side_m", &MarkerIni::side, {0.01, 10}, "Of the black square.");
    addPlace(result);
    result.number("z_m", &MarkerIni::z, Range::positive(), "On a wall: height of its middle above the floor.")
        .flag("landmark", &MarkerIni::is_landmark, "Its middle is a landmark of range-bearing sensors too.");
    return result;
  }();
  return table;
}

const OptionTable<LandmarkIni>& LandmarkIni::table() {
  static const auto table = OptionTable<LandmarkIni>()
                                .integer("id", &LandmarkIni::id, Range::notNegative(), "As sensors report it.")
                                .number("x_m", &LandmarkIni::x, kAnywhere, "Where it is in the map.")
                                .number("y_m", &LandmarkIni::y, kAnywhere, "The same along y.")
                                .number("z_m", &LandmarkIni::z, kAnywhere, "The same, up.");
  return table;
}

const OptionTable<PersonIni>& PersonIni::table() {
  static const auto table =
      OptionTable<PersonIni>()
          .number("height_m", &PersonIni::height, {0.8, 2.3}, "Of the person.")
          .number("yaw_deg", &PersonIni::yaw, kAnywhere, "Where it looks until it first walks or points.")
          .list("path", &PersonIni::path_words, "Where it is when: 'time x y' in s and m, groups separated by |.")
          .list("pointing", &PersonIni::pointing_words,
                "'begin end target [arm]' in s, groups separated by |; the target is the name of a thing, or x y z in "
                "m; the "
                "arm is right or left, right if none is said.");
  return table;
}

}  // namespace omnimapper::sim
