// omnimapper-export: writes a map for other programs and people.
#include <omnimapper/ros_export/exportRos.h>
#include <omnimapper/server/exportPage.h>

#include <iostream>
#include <string>

#include "program/Program.h"
#include "program/shippedFolder.h"

namespace {

using namespace omnimapper;

struct Arguments {
  std::string map, output;
  bool quiet = false;
};

CLI::App* addVerb(CLI::App& app, const std::string& name, const std::string& help, const std::string& output_help,
                  Arguments& arguments) {
  CLI::App* verb = app.add_subcommand(name, help);
  verb->add_option("MAP", arguments.map, "folder of a map, or a map file")->type_name("")->required();
  verb->add_option("OUT", arguments.output, output_help)->type_name("")->required();
  verb->add_flag("-q,--quiet", arguments.quiet, "print nothing but errors");
  return verb;
}

void writePage(const Arguments& arguments) {
  server::exportPage(arguments.map, program::shippedFolder("web"), arguments.output);
  if (!arguments.quiet) std::cout << "The page is " << arguments.output << "/index.html\n";
}

void writeRos(const Arguments& arguments) {
  const auto exported = ros_export::exportRos(arguments.map, arguments.output);
  if (arguments.quiet) return;
  std::cout << arguments.output << ": " << exported.poses << " poses (/tf, /odometry, /path), " << exported.landmarks
            << " landmarks (/landmarks)" << (exported.has_grid ? ", the grid (/map)" : "")
            << "; the fixed frame is map\n";
  for (const auto& note : exported.notes) std::cout << note << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Writes a map for other programs and people.", "omnimapper-export");
  const auto* page = addVerb(app, "page", "a folder with the page of a map, which a browser opens without a server",
                             "folder for the page, created if missing", arguments);
  addVerb(app, "ros", "an MCAP file with poses, grid and landmarks, for Foxglove, RViz and rosbag2",
          "MCAP file to write, as map.mcap", arguments);
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  omnimapper-export page out/map out/page       open out/page/index.html, or copy it to a web server\n"
      "  omnimapper-export ros out/map map.mcap        open map.mcap in Foxglove, or: ros2 bag play map.mcap\n"
      "Exit codes: doc/exit_codes.md. More: doc/page.md, doc/logs.md.");
  return program::run(app, argc, argv, [&] {
    page->parsed() ? writePage(arguments) : writeRos(arguments);
    return 0;
  });
}
