#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/building/RoomsEditRun.h>
#include <omnimapper/building/RoomsFile.h>
#include <omnimapper/building/RoomsOfCells.h>
#include <omnimapper/building/RoomsPicture.h>
#include <omnimapper/building/RoomsPlan.h>

#include <charconv>
#include <cmath>
#include <filesystem>

namespace omnimapper::building {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuseEdit(const std::string& reason) {
  throw base::Error(base::ExitCode::command_line, reason);
}

double metresOf(const std::string& word) {
  double number = 0;
  const char* const end = word.data() + word.size();
  const auto read = std::from_chars(word.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || !(std::abs(number) <= kFarthest))
    refuseEdit("'" + base::printable(word.substr(0, 40)) + "' is not a coordinate in metres of at most a million");
  return number;
}

// A point by which an edit finds the room again: its centre.
Eigen::Vector2d roomCalled(const Storey& storey, const std::string& word) {
  const Room* found = nullptr;
  for (const Room& room : storey.rooms) {
    const std::string number = std::to_string(room.id);
    if (word == number || word == "room " + number) return room.centre;
    if (word != nameOf(room)) continue;
    if (found) refuseEdit("several rooms are called '" + base::printable(word.substr(0, 40)) + "': give the number");
    found = &room;
  }
  if (!found) refuseEdit("no room is called '" + base::printable(word.substr(0, 40)) + "'");
  return found->centre;
}

Eigen::Vector2d doorCalled(const Storey& storey, const std::string& word) {
  for (const Door& door : storey.doors)
    if (word == std::to_string(door.id) || word == "door " + std::to_string(door.id))
      return geometry::middle(door.opening);
  refuseEdit("there is no door " + base::printable(word.substr(0, 40)));
}

RoomEdit editOf(const Storey& storey, const std::vector<std::string>& words) {
  using Kind = RoomEdit::Kind;
  const std::string verb = words.empty() ? "" : words.front();
  const auto at = [&](std::size_t i) { return Eigen::Vector2d(metresOf(words[i]), metresOf(words[i + 1])); };
  if (verb == "rename" && words.size() == 3) {
    if (words[2].empty() || words[2].size() > 200 || base::printable(words[2]) != words[2])
      refuseEdit("a name has 1 to 200 bytes and no control characters");
    return {Kind::rename, words[2], {roomCalled(storey, words[1])}};
  }
  if (verb == "merge" && words.size() == 3)
    return {Kind::merge, "", {roomCalled(storey, words[1]), roomCalled(storey, words[2])}};
  if (verb == "split" && words.size() == 5) return {Kind::split, "", {at(1), at(3)}};
  if (verb == "delete" && words.size() == 2) return {Kind::remove, "", {roomCalled(storey, words[1])}};
  if (verb == "move-door" && words.size() == 6)
    return {Kind::move_door, "", {doorCalled(storey, words[1]), at(2), at(4)}};
  refuseEdit(
      "after edit give one of: rename ROOM NAME, merge ROOM ROOM, split X Y X Y, delete ROOM, move-door DOOR X Y X Y; "
      "ROOM is a number or a name, X Y are metres in the map");
}

void put(const std::string& folder, const std::string& name, const std::string& bytes) {
  base::writeFile((fs::path(folder) / name).string(), [&](std::ostream& out) { out << bytes; });
}

}  // namespace

std::string editedFolder(const RoomsEditRequest& request) {
  const fs::path given(request.folder);
  if (fs::is_directory(given)) return given.string();
  return given.has_parent_path() ? given.parent_path().string() : ".";
}

RoomsEditResult runRoomsEdit(const RoomsEditRequest& request) {
  const fs::path given(request.folder);
  const std::string folder = editedFolder(request);
  const std::string grid_file = fs::is_directory(given) ? (given / "grid.yaml").string() : given.string();
  const std::string rooms_file = (fs::path(folder) / "rooms.json").string();
  RoomsDocument document = decodeRooms(base::readInput(rooms_file, "rooms"), rooms_file);
  const grid::GridMap grid = grid::readGridMap(grid_file);
  Storey& storey = document.building.storeys.front();
  const RoomEdit edit = editOf(storey, request.words);
  Segmentation rooms{storey, roomsOfCells(storey, grid)};
  if (const auto why_not = applyEdit(edit, grid, rooms); !why_not.empty()) refuseEdit(why_not);
  storey = rooms.storey;
  const auto signs = document.edits.signs;
  document.edits.edits.push_back(edit);
  document.edits = anchoredTo(std::move(document.edits), storey, signs);
  const std::string text = encodeRooms(document);
  decodeRooms(text, "the rooms after " + toString(edit));  // what could not be read again must not be written
  put(folder, "edits.json", encodeEdits(document.edits));
  put(folder, "rooms.png", draw::encodePng(drawRooms(grid, rooms)));
  put(folder, "plan.svg", encodePlan(storey));
  put(folder, "rooms.json", text);
  return {toString(edit) + "\n", text};
}

}  // namespace omnimapper::building
