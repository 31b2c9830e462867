#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/building/Continuation.h>
#include <omnimapper/building/RoomsFile.h>
#include <omnimapper/building/RoomsPicture.h>
#include <omnimapper/building/RoomsPlan.h>
#include <omnimapper/building/RoomsRun.h>

#include <algorithm>
#include <filesystem>

namespace omnimapper::building {

namespace {

namespace fs = std::filesystem;

void expectUsable(const RoomsRequest& request, const grid::GridMap& grid) {
  constexpr std::size_t kMostCells = 100'000'000;
  if (grid.cells.size() > kMostCells)
    throw base::Error(base::ExitCode::out_of_memory,
                      request.grid + ": the grid has " + std::to_string(grid.cells.size() / 1'000'000) +
                          " million cells, more than 100 million. Cut off what has not been seen, or make the cells "
                          "larger: 0.05 m show all doors.");
  if (std::find(grid.cells.begin(), grid.cells.end(), grid::GridCell::free) == grid.cells.end())
    throw base::Error(base::ExitCode::nothing_to_map,
                      request.grid +
                          ": the grid has no free cell. Does the image show a map, and do \"negate\", \"free_thresh\" "
                          "and \"occupied_thresh\" fit it?");
}

std::vector<std::string> warningsAbout(const RoomsRequest& request, const grid::GridMap& grid) {
  constexpr double kCoarse = 0.12;  // [m]
  std::vector<std::string> warnings;
  if (grid.resolution > kCoarse)
    warnings.push_back(request.grid + ": in cells of " + base::brief(grid.resolution) +
                       " m doors are hardly visible, so rooms may not be separated. Is \"resolution\" right?");
  if (std::find(grid.cells.begin(), grid.cells.end(), grid::GridCell::occupied) == grid.cells.end())
    warnings.push_back(request.grid + ": no cell is occupied, so rooms end only where nothing was seen.");
  return warnings;
}

std::string padded(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string listOf(const std::vector<int>& ids) {
  constexpr std::size_t kMost = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(ids.size(), kMost); ++i) list += (i > 0 ? " " : "") + std::to_string(ids[i]);
  return ids.empty() ? "-" : list + (ids.size() > kMost ? " ..." : "");
}

std::string summaryOf(const Storey& storey) {
  constexpr std::size_t kMostRows = 15;
  std::vector<const Room*> rooms;
  double area = 0;
  std::size_t open = 0;
  for (const Room& room : storey.rooms) {
    rooms.push_back(&room);
    area += room.area;
    open += room.isOpen() ? 1 : 0;
  }
  std::stable_sort(rooms.begin(), rooms.end(), [](const Room* a, const Room* b) { return a->area > b->area; });
  std::string text = base::counted(rooms.size(), "room") + ", " + base::counted(storey.doors.size(), "door") + ", " +
                     base::fixed(area, 1) + " m2";
  if (open > 0) text += "; " + std::to_string(open) + " seen in part (open)";
  text += "\n room  area [m2]  confidence  neighbours\n";
  for (std::size_t i = 0; i < std::min(rooms.size(), kMostRows); ++i)
    text += padded(std::to_string(rooms[i]->id), 5) + padded(base::fixed(rooms[i]->area, 1), 11) +
            padded(base::fixed(rooms[i]->confidence, 2), 12) + "  " + listOf(rooms[i]->neighbours) +
            (rooms[i]->isOpen() ? "  (open)" : "") + "\n";
  if (rooms.size() > kMostRows) text += "  and " + std::to_string(rooms.size() - kMostRows) + " smaller ones\n";
  return text;
}

std::string changesOf(const Storey& earlier, const Continuation& continued) {
  std::string splits;
  std::size_t fresh = 0;
  for (const Room& room : continued.now.storey.rooms) {
    if (room.id < earlier.next_room) continue;
    ++fresh;
    if (room.split_from)
      splits += "room " + std::to_string(room.id) + " was a part of room " + std::to_string(*room.split_from) + "\n";
  }
  return base::counted(continued.now.storey.rooms.size() - fresh, "room") + " as before, " + std::to_string(fresh) +
         " new, gone: " + listOf(continued.gone) + "\n" + splits;
}

void write(const std::string& folder, const std::string& name, const std::string& bytes) {
  base::writeFile((fs::path(folder) / name).string(), [&](std::ostream& out) { out << bytes; });
}

}  // namespace

RoomsResult runRooms(const RoomsRequest& request) {
  const grid::GridMap grid = grid::readGridMap(request.grid);
  expectUsable(request, grid);
  Building earlier;
  if (!request.earlier.empty()) earlier = readRooms(request.earlier);
  RoomsResult result;
  result.warnings = warningsAbout(request, grid);
  Continuation rooms{segmentRooms(grid), {}};
  if (rooms.now.storey.rooms.empty())
    throw base::Error(base::ExitCode::nothing_to_map, request.grid + ": the grid has free cells, but no room of " +
                                                          base::brief(SegmentationOptions().least_area) +
                                                          " m2. Is \"resolution\" right?");
  std::string changes;
  if (!earlier.storeys.empty()) {
    rooms = continueRooms(earlier.storeys.front(), grid, std::move(rooms.now));
    changes = changesOf(earlier.storeys.front(), rooms);
  }
  base::makeWritableFolder(request.output);
  write(request.output, "rooms.png", draw::encodePng(drawRooms(grid, rooms.now)));
  write(request.output, "plan.svg", encodePlan(rooms.now.storey));
  write(request.output, "rooms.json", encodeRooms({{rooms.now.storey}}, rooms.gone));
  result.text = summaryOf(rooms.now.storey) + changes;
  return result;
}

}  // namespace omnimapper::building
