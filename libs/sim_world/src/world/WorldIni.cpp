#include <omnimapper/sim_world/Furniture.h>
#include <omnimapper/sim_world/Generators.h>
#include <omnimapper/sim_world/ObjectMaking.h>
#include <omnimapper/sim_world/WorldIni.h>

#include <algorithm>
#include <cmath>

#include "CompanionGroups.h"
#include "PlanTables.h"
#include "WallThings.h"

namespace omnimapper::sim {

namespace {

using base::option_text::format;

// One section whose class has been checked.
struct Entry {
  const WorldPlan& plan;  // for messages
  const base::ConfigSection section;
  std::string name, class_name;

  [[noreturn]] void refuse(const std::string& key, const std::string& what) const {
    sim::refuse(plan, name, key, what);
  }
  double number(const std::string& key, const std::string& word) const {
    double value = 0;
    if (base::option_text::parse(word, {}, value)) refuse(key, "'" + word + "' is not a number");
    return value;
  }
};

Entry open(const base::Config& config, const WorldPlan& plan, const std::string& name,
           const std::vector<std::string>& classes, const std::string& usual_class = "") {
  if (!config.has(name)) refuse(plan, "world", "lists", "there is no section [" + name + "]");
  Entry entry{plan, config.section(name), name, classes.size() == 1 ? classes.front() : usual_class};
  entry.section.find("class", entry.class_name);
  if (std::find(classes.begin(), classes.end(), entry.class_name) == classes.end()) {
    const std::string near = base::nearestName(entry.class_name, classes);
    throw base::Error(base::ExitCode::unknown_plugin, config.file() + ": [" + name + "] class = " + entry.class_name +
                                                          ": there is no class of that name" +
                                                          (near.empty() ? "" : "; did you mean '" + near + "'?") +
                                                          " Known: " + format(classes));
  }
  return entry;
}

template <class Ini>
Ini read(const Entry& entry) {
  Ini ini = entry.section.read<Ini>({"class"});
  ini.name = entry.name;
  return ini;
}

Ring readRing(const Entry& entry, const std::string& key, const std::vector<std::string>& words) {
  if (words.size() % 2 != 0) entry.refuse(key, "must be pairs of x and y");
  Ring ring;
  for (std::size_t i = 0; i + 1 < words.size(); i += 2)
    ring.emplace_back(entry.number(key, words[i]), entry.number(key, words[i + 1]));
  return ring;
}

RoomPlan readRoom(const Entry& entry) {
  const RoomIni ini = read<RoomIni>(entry);
  RoomPlan room = ini;
  room.is_outdoors = entry.class_name == "outdoors";
  if (ini.outline_words.empty() == ini.rectangle_words.empty())
    entry.refuse("outline_m", "one of rectangle_m and outline_m must be given");
  if (!ini.outline_words.empty()) {
    room.outline = readRing(entry, "outline_m", ini.outline_words);
    return room;
  }
  const Ring corners = readRing(entry, "rectangle_m", ini.rectangle_words);
  if (corners.size() != 2) entry.refuse("rectangle_m", "must be two corners: x y x y");
  if (corners[0].x() == corners[1].x() || corners[0].y() == corners[1].y())
    entry.refuse("rectangle_m", "must have a length and a width above 0");
  room.outline = rectangle(corners[0].cwiseMin(corners[1]), corners[0].cwiseMax(corners[1]));
  return room;
}

OpeningPlan readOpening(const Entry& entry) {
  using Kind = OpeningPlan::Kind;
  OpeningIni ini = read<OpeningIni>(entry);
  ini.kind = entry.class_name == "window" ? Kind::window : entry.class_name == "passage" ? Kind::passage : Kind::door;
  std::string given;
  // The defaults of the table are those of a door; a window has others.
  if (ini.kind == Kind::window && !entry.section.find("sill_m", given)) ini.sill = 0.9;
  if (ini.kind == Kind::window && !entry.section.find("height_m", given)) ini.height = 1.2;
  return ini;
}

// Divides words into groups that are separated by |.
std::vector<std::vector<std::string>> groupsOf(const std::vector<std::string>& words) {
  std::vector<std::vector<std::string>> groups;
  bool is_new = true;
  for (const std::string& word : words) {
    if (word == "|") {
      is_new = true;
      continue;
    }
    if (is_new) groups.emplace_back();
    is_new = false;
    groups.back().push_back(word);
  }
  return groups;
}

// Reads 'x y yaw [on]' from a word of a group on.
PlacePlan readPlace(const Entry& entry, const std::string& key, const std::vector<std::string>& group,
                    std::size_t from) {
  PlacePlan place;
  place.x = entry.number(key, group[from]);
  place.y = entry.number(key, group[from + 1]);
  place.yaw = entry.number(key, group[from + 2]) * base::option_text::kRadiansPerDegree;
  if (group.size() > from + 3) place.on = group[from + 3];
  return place;
}

std::vector<MovePlan> readMoves(const Entry& entry, const std::vector<std::string>& words) {
  std::vector<MovePlan> moves;
  for (const auto& group : groupsOf(words)) {
    MovePlan move;
    if (group.size() == 2 && group[1] == "away") {
      move.time = entry.number("moves", group[0]);
    } else if (group.size() == 4 || group.size() == 5) {
      move.time = entry.number("moves", group[0]);
      move.place = readPlace(entry, "moves", group, 1);
    } else {
      entry.refuse("moves", "'" + format(group) + "' must be 'time x y yaw', 'time x y yaw on' or 'time away'");
    }
    moves.push_back(move);
  }
  return moves;
}

Person::Pointing readPointing(const Entry& entry, std::vector<std::string> words) {
  const std::string group = format(words);
  Person::Pointing act;
  if (!words.empty() && (words.back() == "left" || words.back() == "right") && words.size() > 3) {
    act.right_arm = words.back() == "right";
    words.pop_back();
  }
  if (words.size() != 3 && words.size() != 5) {
    entry.refuse("pointing", "'" + group +
                                 "' must be 'begin end target' or 'begin end x y z', optionally followed by the arm: " +
                                 "right (the default) or left");
  }
  act.begin = entry.number("pointing", words[0]);
  act.end = entry.number("pointing", words[1]);
  if (words.size() == 3) act.target = words[2];
  for (std::size_t i = 2; i < words.size() && words.size() == 5; ++i)
    act.target_in_map[static_cast<int>(i) - 2] = entry.number("pointing", words[i]);
  return act;
}

std::vector<CarryPlan> readCarryings(const Entry& entry, const std::vector<std::string>& words) {
  std::vector<CarryPlan> carryings;
  for (const auto& group : groupsOf(words)) {
    if (group.size() != 6 && group.size() != 7)
      entry.refuse("carrying", "'" + format(group) + "' must be 'begin end object x y yaw', optionally followed by on");
    carryings.push_back({entry.name, entry.number("carrying", group[0]), entry.number("carrying", group[1]), group[2],
                         readPlace(entry, "carrying", group, 3)});
  }
  return carryings;
}

PersonSpec readPerson(const Entry& entry, const PersonIni& ini, std::uint64_t seed) {
  PersonSpec person;
  person.name = entry.name;
  person.height = ini.height;
  person.yaw = ini.yaw;
  person.seed = seed;
  for (const auto& group : groupsOf(ini.path_words)) {
    if (group.size() != 3) entry.refuse("path", "'" + format(group) + "' must be 'time x y'");
    person.waypoints.push_back(
        {{entry.number("path", group[1]), entry.number("path", group[2])}, entry.number("path", group[0])});
  }
  for (const auto& group : groupsOf(ini.pointing_words)) person.acts.push_back(readPointing(entry, group));
  return person;
}

CompanionPlan readCompanion(const Entry& entry) {
  const CompanionIni ini = read<CompanionIni>(entry);
  if (ini.until > 0 && ini.until <= ini.from) entry.refuse("until_s", "must be after from_s, or 0");
  const bool is_inside = ini.place == CompanionPlan::Place::beside && ini.side != 0 && std::abs(ini.side) < 0.5;
  if (is_inside)
    entry.refuse("side_m", "must be at least 0.5 m to either side, so that the person is not in the robot");
  return ini;
}

PlacePlan placeOf(const PlaceIni& ini) {
  return {ini.x, ini.y, ini.yaw, ini.on};
}

ObjectPlan readObject(const Entry& entry) {
  const ObjectIni ini = read<ObjectIni>(entry);
  ObjectPlan object = ini;
  object.shape = entry.class_name;
  object.place = placeOf(ini);
  object.moves = readMoves(entry, ini.move_words);
  return object;
}

SignPlan readSign(const Entry& entry) {
  const SignIni ini = read<SignIni>(entry);
  SignPlan sign = ini;
  sign.style = entry.class_name;
  sign.at = {ini.x, ini.y, ini.z};
  std::string line;
  for (const char c : ini.text + "|") {
    if (c != '|') {
      line += c;
      continue;
    }
    const auto first = line.find_first_not_of(' ');
    if (first != std::string::npos) sign.lines.push_back(line.substr(first, line.find_last_not_of(' ') - first + 1));
    line.clear();
  }
  return sign;
}

PosterPlan readPoster(const Entry& entry) {
  const PosterIni ini = read<PosterIni>(entry);
  PosterPlan poster = ini;
  poster.kind = entry.class_name;
  poster.at = {ini.x, ini.y, ini.z};
  return poster;
}

MarkerPlan readMarker(const Entry& entry) {
  const MarkerIni ini = read<MarkerIni>(entry);
  MarkerPlan marker = ini;
  marker.on_wall = entry.class_name == "wall";
  marker.at = {ini.x, ini.y, ini.z};
  marker.place = placeOf(ini);
  marker.moves = readMoves(entry, ini.move_words);
  return marker;
}

std::vector<std::string> furnitureNames() {
  std::vector<std::string> names;
  for (const auto* shapes : {&furnitureShapes(), &outdoorShapes()}) {
    for (const FurnitureShape& shape : *shapes) names.emplace_back(shape.name);
  }
  return names;
}

const std::vector<std::string> kRoomClasses{"room", "outdoors"}, kDoorClasses{"door", "passage", "window"},
    kMarkerClasses{"wall", "stand"}, kLandmarkClasses{"point"}, kPersonClasses{"person", "companion"};

}  // namespace

void refuse(const WorldPlan& plan, const std::string& section, const std::string& key, const std::string& what) {
  throw base::Error(base::ExitCode::out_of_range, plan.file + ": [" + section + "] " + key + ": " + what);
}

WorldPlan readWorldPlan(const base::Config& config) {
  const WorldOptions options = config.section("world").read<WorldOptions>();
  WorldPlan plan = generate(options, config.file());
  const auto each = [&](const std::vector<std::string>& names, const std::vector<std::string>& classes, auto&& take) {
    for (const std::string& name : names) take(open(config, plan, name, classes));
  };
  each(options.rooms, kRoomClasses, [&](const Entry& entry) { plan.rooms.push_back(readRoom(entry)); });
  each(options.doors, kDoorClasses, [&](const Entry& entry) { plan.openings.push_back(readOpening(entry)); });
  each(options.furniture, furnitureNames(), [&](const Entry& entry) {
    plan.furniture.push_back(read<FurnitureIni>(entry));
    plan.furniture.back().shape = entry.class_name;
  });
  each(options.objects, objectShapes(), [&](const Entry& entry) { plan.objects.push_back(readObject(entry)); });
  each(options.signs, signStyleNames(), [&](const Entry& entry) { plan.signs.push_back(readSign(entry)); });
  each(options.posters, posterKindNames(), [&](const Entry& entry) { plan.posters.push_back(readPoster(entry)); });
  each(options.markers, kMarkerClasses, [&](const Entry& entry) { plan.markers.push_back(readMarker(entry)); });
  each(options.landmarks, kLandmarkClasses,
       [&](const Entry& entry) { plan.landmarks.push_back(read<LandmarkIni>(entry)); });
  for (const std::string& name : options.people) {
    const Entry entry = open(config, plan, name, kPersonClasses, kPersonClasses.front());
    if (entry.class_name == "companion") {
      plan.companions.push_back(readCompanion(entry));
      continue;
    }
    const auto ini = entry.section.read<PersonIni>({"class"});
    plan.people.push_back(readPerson(entry, ini, plan.seed * 1000 + plan.people.size()));
    for (CarryPlan& carrying : readCarryings(entry, ini.carrying_words)) plan.carryings.push_back(std::move(carrying));
  }
  const std::vector<CompanionPlan> group = companionsOf(options.companions, plan.seed);
  plan.companions.insert(plan.companions.end(), group.begin(), group.end());
  for (std::size_t i = 0; i < plan.companions.size(); ++i) plan.companions[i].seed = plan.seed * 1000 + 500 + i;
  return plan;
}

World readWorld(const base::Config& config) {
  return makeWorld(readWorldPlan(config));
}

std::vector<WorldSectionReference> worldSectionReferences() {
  return {{"rooms", kRoomClasses, RoomIni::table().specs()},
          {"doors", kDoorClasses, OpeningIni::table().specs()},
          {"furniture", furnitureNames(), FurnitureIni::table().specs()},
          {"objects", objectShapes(), ObjectIni::table().specs()},
          {"signs", signStyleNames(), SignIni::table().specs()},
          {"posters", posterKindNames(), PosterIni::table().specs()},
          {"markers", kMarkerClasses, MarkerIni::table().specs()},
          {"landmarks", kLandmarkClasses, LandmarkIni::table().specs()},
          {"people", {kPersonClasses[0]}, PersonIni::table().specs()},
          {"people", {kPersonClasses[1]}, CompanionIni::table().specs()}};
}

}  // namespace omnimapper::sim
