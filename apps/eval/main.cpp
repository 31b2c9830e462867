#include "Verbs.h"
#include "program/Program.h"

namespace {

using namespace omnimapper;
using evaluation::Arguments;

constexpr char kPoses[] = "truth: TUM, or MRPT's .GT.txt";

void addOutputs(CLI::App* verb, Arguments& arguments) {
  verb->add_option("-o,--output", arguments.output_folder, "folder for numbers.json and plots, made if missing");
  verb->add_option("--json", arguments.json_file, "file for the numbers");
}

CLI::App* addVerb(CLI::App& app, const std::string& name, const std::string& help, const std::string& reference,
                  Arguments& arguments) {
  CLI::App* verb = app.add_subcommand(name, help);
  verb->add_option("estimate", arguments.estimate, "trajectory to be judged, TUM format")->required();
  verb->add_option("reference", arguments.reference, reference)->required();
  addOutputs(verb, arguments);
  verb->add_option("--tolerance", arguments.tolerance, "between stamps that belong together [s], default 0.01")
      ->check(omnimapper::program::notNegative());
  return verb;
}

void addPairing(CLI::App* verb, Arguments& arguments) {
  verb->add_option("--align", arguments.alignment, "none, first, yaw, se3 or sim3; default none");
  verb->add_option("--interpolate", arguments.interpolate, "interpolate the reference over gaps up to this [s]")
      ->check(omnimapper::program::positive());
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  std::string map_alignment = "se3";
  CLI::App app("Says how far a trajectory or a map is from the truth.", "omnimapper-eval");
  addPairing(addVerb(app, "ate", "absolute trajectory error", kPoses, arguments), arguments);
  CLI::App* rpe = addVerb(app, "rpe", "relative pose error", kPoses, arguments);
  addPairing(rpe, arguments);
  rpe->add_option("--delta", arguments.delta, "span over which motion is compared, default 1");
  rpe->add_option("--unit", arguments.unit, "of the delta: frames, s or m; default frames");
  addVerb(app, "relations", "metric of Kuemmerle et al. 2009 over relations checked by hand", "relations", arguments)
      ->add_option("--base-from-sensor", arguments.base_from_sensor, "x y [m] yaw [deg] of the relations' sensor")
      ->expected(3);
  CLI::App* map = app.add_subcommand("map", "surfaces of a map against the true ones");
  map->add_option("map", arguments.estimate, "folder of a map, or its surfaces.json")->required();
  map->add_option("world", arguments.reference, "folder of the simulated log, or its surfaces.json")->required();
  addOutputs(map, arguments);
  map->add_option("--align", map_alignment, "by trajectory.tum and truth.tum in the folders: none, first, yaw or se3")
      ->capture_default_str();
  CLI::App* views = app.add_subcommand("views", "surfaces of a map against the depth images of a log on known poses");
  views->add_option("map", arguments.estimate, "folder of a map, or its surfaces.json")->required();
  views->add_option("log", arguments.log, "rawlog with depth images")->required();
  views->add_option("trajectory", arguments.reference, "poses of the base in that log: TUM")->required();
  addOutputs(views, arguments);
  views->add_option("--align", map_alignment, "by trajectory.tum in the map's folder: none, first, yaw or se3")
      ->capture_default_str();
  views->add_option("--tolerance", arguments.tolerance, "between stamps of an image and its pose [s], default 0.01")
      ->check(omnimapper::program::notNegative());
  views->add_option("--interpolate", arguments.interpolate, "interpolate the poses over gaps up to this [s]")
      ->check(omnimapper::program::positive());
  views->add_option("--views", arguments.views, "at most; of more images every second, fourth, ... is one")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  views->footer(
      "Example, a camera whose poses were measured by others:\n"
      "  omnimapper-import tum tum_fr3_cabinet58 cabinet.rawlog --poses\n"
      "  omnimapper-graphslam -i rgbd_planes.ini -r cabinet.rawlog -o out/cabinet\n"
      "  omnimapper-eval views out/cabinet cabinet.rawlog cabinet.truth.tum -o out/views\n"
      "On the map's own poses: omnimapper-eval views out/map LOG out/map/trajectory.tum");
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  omnimapper-eval ate out/trajectory.tum simul.rawlog.GT.txt --align se3 -o out/ate\n"
      "  omnimapper-eval rpe out/trajectory.tum groundtruth.tum --delta 1 --unit m\n"
      "  omnimapper-eval relations out/trajectory.tum aces.relations\n"
      "  omnimapper-eval map out/map out/home -o out/quality\n"
      "  omnimapper-eval views out/cabinet cabinet.rawlog cabinet.truth.tum -o out/views\n"
      "Options of one verb: omnimapper-eval ate --help. Exit codes: doc/exit_codes.md.");
  return program::run(app, argc, argv, [&] {
    if (map->parsed() || views->parsed()) arguments.alignment = map_alignment;
    return evaluation::run(app.get_subcommands().front()->get_name(), arguments);
  });
}
