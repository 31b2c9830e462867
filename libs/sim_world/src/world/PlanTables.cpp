#include "PlanTables.h"

#include <omnimapper/sim_world/WorldIni.h>

namespace omnimapper::sim {

using base::OptionTable;
using base::Range;

namespace {

constexpr Range kAnywhere{};
constexpr Range kSize{0, 100}, kSizeOnWall{0, 5};  // [m]

// Keys of what stands somewhere and is carried elsewhere.
template <class Ini>
void addPlace(OptionTable<Ini>& table) {
  table.number("x_m", &Ini::x, kAnywhere, "x coordinate of the centre in the map.")
      .number("y_m", &Ini::y, kAnywhere, "y coordinate of the centre in the map.")
      .number("yaw_deg", &Ini::yaw, kAnywhere, "Yaw in the map. At 0 the front faces -y.")
      .text("on", &Ini::on,
            "Level surface that the item stands on, such as table_1/top or, of an object, box_1/top. Empty means the "
            "floor.")
      .list("moves", &Ini::move_words,
            "Moves of the item, separated by |: 'time x y yaw [on]' to carry it elsewhere or 'time away' to remove "
            "it, in s, m and deg.");
}

template <class Ini>
void addOnWall(OptionTable<Ini>& table) {
  table
      .number("x_m", &Ini::x, kAnywhere,
              "x coordinate of a point in the room, at most 0.5 m from the wall that the item hangs on.")
      .number("y_m", &Ini::y, kAnywhere,
              "y coordinate of a point in the room, at most 0.5 m from the wall that the item hangs on.")
      .number("z_m", &Ini::z, Range::positive(), "Height of the centre above the floor.");
}

template <class Ini>
void addSize(OptionTable<Ini>& table) {
  table.number("length_m", &Ini::length, kSize, "Length along the front. 0 means the usual length.")
      .number("width_m", &Ini::width, kSize, "Width from front to back. 0 means the usual width.")
      .number("height_m", &Ini::height, kSize, "Height from bottom to top. 0 means the usual height.");
}

}  // namespace

const OptionTable<WorldOptions>& WorldOptions::table() {
  static const auto table =
      OptionTable<WorldOptions>()
          .integer("seed", &WorldOptions::seed, Range::notNegative(),
                   "Seed of everything that is drawn at random in the world.")
          .text("generator", &WorldOptions::generator,
                "Generator of a whole place: none, home, office, laboratory, two_offices, loop, corridor_loop, box or "
                "road.")
          .integer("plan_seed", &WorldOptions::plan_seed, Range::notNegative(),
                   "Seed of the rooms, doors, windows and ceilings of a generated home, office or laboratory. 0 means "
                   "the fixed plan, the only one that other places have.")
          .choice("clutter", &WorldOptions::clutter,
                  {{"low", ClutterLevel::low}, {"medium", ClutterLevel::medium}, {"high", ClutterLevel::high}},
                  "Amount of clutter that stands about in a generated place.")
          .choice(
              "object_clutter", &WorldOptions::object_clutter,
              {{"none", ObjectClutter::none},
               {"low", ObjectClutter::low},
               {"medium", ObjectClutter::medium},
               {"high", ObjectClutter::high}},
              "Additional objects on tables, counters and shelves of a generated place: some 2, 5 or 10 groups on a "
              "square metre, as far as there is room. Thin objects, pairs that touch and stacks are among them. "
              "They change nothing else.")
          .number("length_m", &WorldOptions::length, {24, 1000},
                  "Length of a generated loop along the middle of its corridor.")
          .number("move_time_s", &WorldOptions::move_time, kAnywhere,
                  "Time at which moveable objects of a generated place are carried elsewhere. A negative time means "
                  "never.")
          .number("wear", &WorldOptions::wear, {0, 0.3},
                  "Standard deviation over mean of the brightness of static bodies, from stains, scuffs and grain that "
                  "never repeat. With 0 all is new, and a camera finds almost no texture on walls.")
          .choice("sign_style", &WorldOptions::sign_style, {{"dark", "dark"}, {"white", "white"}},
                  "Style of the door signs of a generated place, which decides their look and how high they hang.")
          .integer("repeated_signs", &WorldOptions::repeated_signs, {0, 1000},
                   "Number of door signs of a generated place that bear Storage, Women or Men and no number. They "
                   "belong to doors of rooms that do not exist.")
          .flag("exit_signs", &WorldOptions::exit_signs,
                "An exit sign hangs on the wall that each corridor of a generated place leads up to, clockwise around "
                "the building.")
          .integer("announcements", &WorldOptions::announcements, {0, 1000},
                   "Largest number of posters with numbers in the corridors of a generated place. Fewer hang there if "
                   "there is not enough room.")
          .text("hall_wall", &WorldOptions::hall_wall,
                "Material of the corridor walls of a generated place. Empty means the usual material there.")
          .choice(
              "companions", &WorldOptions::companions,
              {{"none", CompanionGroup::none},
               {"guide", CompanionGroup::guide},
               {"guests", CompanionGroup::guests},
               {"group", CompanionGroup::group},
               {"crowd", CompanionGroup::crowd}},
              "People who accompany the robot, in addition to those of sections: nobody, one who leads it and stops "
              "at doors, one beside and one behind it, five who hide the walls, or these five with one behind and "
              "one who crosses the path.")
          .list("rooms", &WorldOptions::rooms, "Names of the sections that describe rooms.")
          .list("doors", &WorldOptions::doors, "Names of the sections that describe doors, passages and windows.")
          .list("furniture", &WorldOptions::furniture, "Names of the sections that describe furniture.")
          .list("objects", &WorldOptions::objects, "Names of the sections that describe objects.")
          .list("signs", &WorldOptions::signs, "Names of the sections that describe door signs.")
          .list("posters", &WorldOptions::posters,
                "Names of the sections that describe posters and other items on walls.")
          .list("markers", &WorldOptions::markers, "Names of the sections that describe square markers.")
          .list("landmarks", &WorldOptions::landmarks, "Names of the sections that describe point landmarks.")
          .list("people", &WorldOptions::people, "Names of the sections that describe people.");
  return table;
}

const OptionTable<RoomIni>& RoomIni::table() {
  static const auto table =
      OptionTable<RoomIni>()
          .list("rectangle_m", &RoomIni::rectangle_words, "Two opposite corners of the room's free interior: x y x y.")
          .list("outline_m", &RoomIni::outline_words,
                "All corners of the room's free interior in order, instead of rectangle_m: x y x y x y ...")
          .text("kind", &RoomIni::kind, "Use of the room: kitchen, office, corridor, road, ...")
          .text("number", &RoomIni::number, "Number of the room, as on door signs.")
          .number("floor_m", &RoomIni::floor_z, {-1000, 1000}, "Height of the floor at the first corner of the room.")
          .number("height_m", &RoomIni::height, {1.8, 100}, "Height of the room from floor to ceiling.")
          .number("slope_x", &RoomIni::slope_x, {-0.5, 0.5}, "Rise of the floor per metre along x.")
          .number("slope_y", &RoomIni::slope_y, {-0.5, 0.5}, "Rise of the floor per metre along y.")
          .text("wall", &RoomIni::wall, "Material of the room's walls.")
          .text("floor", &RoomIni::floor, "Material of the room's floor.")
          .text("ceiling", &RoomIni::ceiling, "Material of the room's ceiling.");
  return table;
}

const OptionTable<OpeningIni>& OpeningIni::table() {
  using Leaf = OpeningPlan::Leaf;
  static const auto table =
      OptionTable<OpeningIni>()
          .list("rooms", &OpeningIni::rooms,
                "Names of the two rooms that the opening joins. The second may be 'outside'.")
          .number("x_m", &OpeningIni::x, kAnywhere,
                  "x coordinate of a point near the centre of the opening, which is in the wall nearest to the point.")
          .number("y_m", &OpeningIni::y, kAnywhere,
                  "y coordinate of a point near the centre of the opening, which is in the wall nearest to the point.")
          .number("width_m", &OpeningIni::width, Range::notNegative(),
                  "Width of the opening. 0 means the whole width that both rooms share.")
          .number("height_m", &OpeningIni::height, Range::positive(),
                  "Height of the opening from its bottom to its top.")
          .number("sill_m", &OpeningIni::sill, Range::notNegative(),
                  "Height of the bottom of the opening above the floor.")
          .choice("leaf", static_cast<Leaf OpeningIni::*>(&OpeningIni::leaf),
                  {{"none", Leaf::none}, {"open", Leaf::open}, {"closed", Leaf::closed}},
                  "State of the leaf of a door, or none for a door without one.")
          .number("leaf_angle_deg", &OpeningIni::leaf_angle, {0, 180},
                  "Angle by which an open leaf is turned into the first room.")
          .flag("hinge_right", &OpeningIni::hinge_right,
                "The hinge of the leaf is on the right, seen from the first room.")
          .text("material", &OpeningIni::material, "Material of the frame and the leaf.");
  return table;
}

const OptionTable<FurnitureIni>& FurnitureIni::table() {
  static const auto table = [] {
    OptionTable<FurnitureIni> result;
    result.number("x_m", &FurnitureIni::x, kAnywhere, "x coordinate of the centre of the furniture in the map.")
        .number("y_m", &FurnitureIni::y, kAnywhere, "y coordinate of the centre of the furniture in the map.")
        .number("z_m", &FurnitureIni::z, Range::notNegative(),
                "Height of the lowest point of the furniture above the floor. 0 means the usual height.")
        .number("yaw_deg", &FurnitureIni::yaw, kAnywhere, "Yaw of the furniture in the map. At 0 its front faces -y.");
    addSize(result);
    result.integer("boards", &FurnitureIni::boards, {0, 20}, "Number of boards of a shelf. 0 means the usual number.")
        .text("material", &FurnitureIni::material, "Material of the furniture. Empty means the usual material.");
    return result;
  }();
  return table;
}

const OptionTable<ObjectIni>& ObjectIni::table() {
  static const auto table = [] {
    OptionTable<ObjectIni> result;
    addPlace(result);
    addSize(result);
    result.flag("moveable", &ObjectIni::moveable, "People carry the object about.")
        .text(
            "touching", &ObjectIni::touching,
            "Object on the same surface that this one touches at the start: it is slid along the line from the middle "
            "of that object to x_m, y_m until their outlines from above touch. Empty means that it stands at x_m, "
            "y_m.");
    return result;
  }();
  return table;
}

const OptionTable<SignIni>& SignIni::table() {
  static const auto table = [] {
    OptionTable<SignIni> result;
    result.text("room", &SignIni::room, "Name of the room that the sign names.")
        .text("text", &SignIni::text,
              "Lines of text on the sign, separated by |. Empty means number and name of the room.");
    addOnWall(result);
    result.number("width_m", &SignIni::width, kSizeOnWall, "Width of the sign. 0 means the width that its text needs.")
        .number("height_m", &SignIni::height, kSizeOnWall,
                "Height of the sign from its bottom to its top. 0 means the height that its text needs.");
    return result;
  }();
  return table;
}

const OptionTable<PosterIni>& PosterIni::table() {
  static const auto table = [] {
    OptionTable<PosterIni> result;
    addOnWall(result);
    result.number("width_m", &PosterIni::width, kSizeOnWall, "Width of the item on the wall. 0 means the usual width.")
        .number("height_m", &PosterIni::height, kSizeOnWall,
                "Height of the item from its bottom to its top. 0 means the usual height.");
    return result;
  }();
  return table;
}

const OptionTable<MarkerIni>& MarkerIni::table() {
  static const auto table = [] {
    OptionTable<MarkerIni> result;
    result.integer("id", &MarkerIni::id, Range::notNegative(), "Id of the marker in its dictionary.")
        .number("side_m", &MarkerIni::side, {0.01, 10}, "Side length of the marker's black square.");
    addPlace(result);
    result
        .number("z_m", &MarkerIni::z, Range::positive(),
                "Height of the centre above the floor, for a marker on a wall.")
        .flag("landmark", &MarkerIni::is_landmark,
              "The centre of the marker is also a landmark for range-bearing sensors.");
    return result;
  }();
  return table;
}

const OptionTable<LandmarkIni>& LandmarkIni::table() {
  static const auto table =
      OptionTable<LandmarkIni>()
          .integer("id", &LandmarkIni::id, Range::notNegative(), "Id of the landmark, as sensors report it.")
          .number("x_m", &LandmarkIni::x, kAnywhere, "x coordinate of the landmark in the map.")
          .number("y_m", &LandmarkIni::y, kAnywhere, "y coordinate of the landmark in the map.")
          .number("z_m", &LandmarkIni::z, kAnywhere, "z coordinate of the landmark in the map, upwards.");
  return table;
}

const OptionTable<CompanionIni>& CompanionIni::table() {
  using Place = CompanionPlan::Place;
  static const auto table =
      OptionTable<CompanionIni>()
          .number("height_m", &CompanionIni::height, {0.8, 2.3}, "Height of the person.")
          .choice("place", static_cast<Place CompanionIni::*>(&CompanionIni::place),
                  {{"ahead", Place::ahead},
                   {"behind", Place::behind},
                   {"beside", Place::beside},
                   {"crossing", Place::crossing},
                   {"stops", Place::stops}},
                  "Where the person walks: on the robot's path ahead of it or behind it, beside the robot, ahead of it "
                  "on one side of the path and now and then across to the other, or ahead of it with stops, mostly at "
                  "doors, where the person waits for the robot.")
          .number("distance_m", &CompanionIni::distance, {0.6, 10},
                  "Distance of the person from the robot along the robot's path. Beside the robot it does not count.")
          .number("side_m", &CompanionIni::side, {-5, 5},
                  "Offset of the person to the left of the robot's path. Beside the robot, 0 means 0.75 m to the left; "
                  "for one who crosses the path, the person changes from this offset to its opposite, and 0 means "
                  "0.9 m.")
          .number("from_s", &CompanionIni::from, Range::notNegative(),
                  "Time at which the person begins to accompany the robot. Until then it stands where it begins.")
          .number("until_s", &CompanionIni::until, Range::notNegative(),
                  "Time at which the person stops accompanying the robot. From then on it stands there. 0 means the "
                  "end of the drive.");
  return table;
}

const OptionTable<PersonIni>& PersonIni::table() {
  static const auto table =
      OptionTable<PersonIni>()
          .number("height_m", &PersonIni::height, {0.8, 2.3}, "Height of the person.")
          .number("yaw_deg", &PersonIni::yaw, kAnywhere,
                  "Direction in which the person faces until it first walks or points.")
          .list("path", &PersonIni::path_words,
                "Positions of the person over time: 'time x y' in s and m, groups separated by |.")
          .list("pointing", &PersonIni::pointing_words,
                "Pointing gestures: 'begin end target [arm]' in s, groups separated by |. The target is the name of a "
                "body or surface, or x y z in m, and the arm is right or left, right if none is given.")
          .list("carrying", &PersonIni::carrying_words,
                "Objects that the person takes by hand, carries and puts down: 'begin end object x y yaw [on]' in s, m "
                "and deg, groups separated by |. The place is that where the object stands from the end on. The person "
                "must stand within reach of the object at the begin and of its place at the end.");
  return table;
}

}  // namespace omnimapper::sim
