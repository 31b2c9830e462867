#include <omnimapper/base/Numbers.h>
#include <omnimapper/building/DoorSigns.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <tuple>

namespace omnimapper::building {

namespace {

using Eigen::Vector2d;

/// The room or place that a sign names.
struct Named {
  int room = 0;  // 0: none that was seen
  double confidence = 0;
  std::string where;  // "0.3 m beside door 4"
};

// Signs that no room is called by.
bool isOfNoRoom(const std::string& text) {
  std::string lower;
  for (const char c : text) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* other : {"exit", "emergency exit", "notausgang", "ausgang", "push", "pull", "no entry"})
    if (lower == other) return true;
  return false;
}

/// A door as seen from a sign.
struct DoorOfSign {
  const Door* door = nullptr;
  double beside = 0;  // [m] along the wall from the nearer end of the door; 0 above it
  int behind = 0;     // id of the room on the side that the sign does not face
};

std::optional<DoorOfSign> asDoorOf(const DoorSign& sign, const Door& door, const Storey& storey,
                                   const DoorSignOptions& options) {
  const Vector2d along = geometry::direction(door.opening), across(-along.y(), along.x());
  const Vector2d from_middle = sign.position - geometry::middle(door.opening);
  const double beside = std::max(0.0, std::abs(from_middle.dot(along)) - door.width / 2);
  const double facing = sign.facing.dot(across);
  if (beside > options.reach || std::abs(from_middle.dot(across)) > options.off_wall ||
      std::abs(facing) < options.least_facing)
    return std::nullopt;
  // The room behind is the one of both that is not on the side that the sign faces.
  const Vector2d out = facing > 0 ? across : Vector2d(-across);
  for (const double step : {0.3, 0.5, 0.8, 0.15}) {
    const Vector2d middle = geometry::middle(door.opening);
    const Room *before = roomAt(storey, middle + step * out), *behind = roomAt(storey, middle - step * out);
    for (const auto& [one, other] : {std::pair(door.rooms[0], door.rooms[1]), {door.rooms[1], door.rooms[0]}}) {
      const bool fits_before = before && before->id == one, fits_behind = behind && behind->id == other;
      if ((fits_before && (fits_behind || !behind)) || (fits_behind && !before))
        return DoorOfSign{&door, beside, other};
    }
  }
  return std::nullopt;
}

std::optional<DoorOfSign> doorOf(const DoorSign& sign, const Storey& storey, const DoorSignOptions& options) {
  std::optional<DoorOfSign> nearest;
  for (const Door& door : storey.doors) {
    const auto found = asDoorOf(sign, door, storey, options);
    if (found && (!nearest || found->beside < nearest->beside)) nearest = found;
  }
  return nearest;
}

Named namedBy(const DoorSign& sign, const Storey& storey, const DoorSignOptions& options) {
  constexpr double kBeside = 0.95, kBehindWall = 0.5, kRepeated = 0.6;
  const double known = sign.is_repeated ? kRepeated : 1;
  if (const auto found = doorOf(sign, storey, options)) {
    const double far = found->beside / options.reach;
    return {found->behind, known * kBeside * (1 - 0.2 * far) * (0.5 + 0.5 * found->door->confidence),
            base::fixed(found->beside, 1) + " m beside door " + std::to_string(found->door->id)};
  }
  const Room* before = roomAt(storey, sign.position + options.behind * sign.facing);
  const Room* behind = roomAt(storey, sign.position - options.behind * sign.facing);
  if (behind && behind != before)
    return {behind->id, known * kBehindWall, "on the wall of this room, with no door seen beside it"};
  return {0, known * kBeside, "no room was seen behind its wall"};
}

void forgetSigns(Storey& storey) {
  const auto isOfSign = [](const NameEvidence& each) { return each.source == NameEvidence::Source::sign; };
  for (Room& room : storey.rooms) {
    const bool is_of_user = std::any_of(room.why.begin(), room.why.end(), [](const NameEvidence& each) {
      return each.source == NameEvidence::Source::user;
    });
    room.why.erase(std::remove_if(room.why.begin(), room.why.end(), isOfSign), room.why.end());
    if (is_of_user) continue;
    room.name.clear();
    room.name_confidence = 0;
  }
  storey.unseen.clear();
}

// The text that most speaks for; two that say different things make each other doubtful.
void chooseName(Room& room, const std::map<std::string, double>& texts) {
  if (texts.empty() || isNamedByUser(room)) return;
  double most = 0, second = 0;
  for (const auto& [text, confidence] : texts) {
    if (confidence > most) {
      second = most;
      most = confidence;
      room.name = text;
    } else {
      second = std::max(second, confidence);
    }
  }
  room.name_confidence = most * (1 - 0.5 * second);
}

}  // namespace

void nameBySigns(Storey& storey, const std::vector<DoorSign>& signs, const DoorSignOptions& options) {
  forgetSigns(storey);
  std::map<int, std::map<std::string, double>> texts;  // by room
  for (const DoorSign& sign : signs) {
    if (sign.text.empty() || isOfNoRoom(sign.text)) continue;
    const Named named = namedBy(sign, storey, options);
    const NameEvidence why{NameEvidence::Source::sign, "sign \"" + sign.text + "\" (" + sign.id + "), " + named.where,
                           named.confidence};
    if (named.room != 0) {
      double& confidence = texts[named.room][sign.text];
      confidence = std::max(confidence, named.confidence);
      const auto room = std::find_if(storey.rooms.begin(), storey.rooms.end(),
                                     [&](const Room& each) { return each.id == named.room; });
      room->why.push_back(why);
      continue;
    }
    UnseenRoom unseen;
    unseen.name = sign.text;
    unseen.door = sign.position;
    if (const Room* before = roomAt(storey, sign.position + options.behind * sign.facing))
      unseen.seen_from = before->id;
    unseen.confidence = named.confidence;
    unseen.why = {why};
    storey.unseen.push_back(std::move(unseen));
  }
  for (Room& room : storey.rooms) chooseName(room, texts[room.id]);
  std::stable_sort(storey.unseen.begin(), storey.unseen.end(),
                   [](const UnseenRoom& a, const UnseenRoom& b) { return a.name < b.name; });
}

}  // namespace omnimapper::building
