// omnimapper-rooms: finds the rooms and doors of an occupancy grid.
#include <omnimapper/building/RoomsRun.h>

#include <iostream>

#include "program/Program.h"

int main(int argc, char** argv) {
  using namespace omnimapper;
  building::RoomsRequest request;
  bool quiet = false;
  CLI::App app(
      "Finds the rooms and doors of an occupancy grid in the format of ROS map_server, of any program.\n"
      "Example: omnimapper-rooms out/map/grid.yaml -o out/rooms",
      "omnimapper-rooms");
  app.add_option("MAP", request.grid, "YAML file of the grid, which names its image (PGM or PNG)")
      ->type_name("")
      ->required();
  app.add_option("-o,--output", request.output, "folder for rooms.json, rooms.png and plan.svg, created if missing")
      ->required();
  app.add_option("--continue", request.earlier,
                 "rooms.json of an earlier map of the place, in the same frame: its rooms keep their numbers");
  app.add_flag("-q,--quiet", quiet, "no summary");
  app.footer("Exit codes: doc/exit_codes.md (14: the grid shows no room). More: doc/rooms.md.");
  return program::run(app, argc, argv, [&] {
    const auto result = building::runRooms(request);
    for (const auto& warning : result.warnings) std::cerr << "omnimapper-rooms: warning: " << warning << "\n";
    if (!quiet) std::cout << result.text << "in " << request.output << ": rooms.json, rooms.png, plan.svg\n";
    return 0;
  });
}
