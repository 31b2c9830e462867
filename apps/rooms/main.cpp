// omnimapper-rooms: finds the rooms and doors of an occupancy grid, and edits them.
#include <omnimapper/base/Error.h>
#include <omnimapper/building/RoomsRun.h>
#include <omnimapper/query/editRooms.h>

#include <iostream>
#include <string>
#include <vector>

#include "program/Program.h"

namespace {

using namespace omnimapper;

int find(const building::RoomsRequest& request, bool quiet) {
  if (request.output.empty())
    throw base::Error(base::ExitCode::command_line, "give a folder for the results: -o FOLDER");
  const auto result = building::runRooms(request);
  for (const auto& warning : result.warnings) std::cerr << "omnimapper-rooms: warning: " << warning << "\n";
  if (!quiet) std::cout << result.text << "in " << request.output << ": rooms.json, rooms.png, plan.svg\n";
  return 0;
}

int edit(const std::string& map, const std::vector<std::string>& words, bool quiet) {
  const std::string text = query::editRooms(map, words);
  if (!quiet) std::cout << text;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  building::RoomsRequest request;
  std::vector<std::string> words;
  bool quiet = false;
  CLI::App app(
      "Finds the rooms and doors of an occupancy grid in the format of ROS map_server, of any program; with edit, "
      "changes\n"
      "the rooms of a map.\n"
      "Examples: omnimapper-rooms out/map/grid.yaml -o out/rooms\n"
      "          omnimapper-rooms out/map edit rename \"room 3\" kitchen",
      "omnimapper-rooms");
  app.add_option("MAP", request.grid,
                 "YAML file of the grid, which names its image (PGM or PNG); for edit, a folder with grid.yaml and "
                 "rooms.json, such as that of a map")
      ->type_name("")
      ->required();
  app.add_option("-o,--output", request.output, "folder for rooms.json, rooms.png and plan.svg, created if missing");
  app.add_option("--continue", request.earlier,
                 "rooms.json of an earlier map of the place, in the same frame: its rooms keep their numbers");
  app.add_flag("-q,--quiet", quiet, "no summary");
  CLI::App* editing = app.add_subcommand("edit", "changes the rooms of a map, and keeps the edit for later maps");
  editing
      ->add_option("EDIT", words,
                   "rename ROOM NAME, merge ROOM ROOM, split X Y X Y, delete ROOM, or move-door DOOR X Y X Y")
      ->type_name("")
      ->expected(0, -1);
  app.footer("Exit codes: doc/exit_codes.md (14: the grid shows no room). More: doc/rooms.md.");
  return program::run(app, argc, argv,
                      [&] { return editing->parsed() ? edit(request.grid, words, quiet) : find(request, quiet); });
}
