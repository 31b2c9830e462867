#include "EvalVerbs.h"
#include "program/Program.h"

namespace {

using namespace omnimapper;
using evaluation::Arguments;

constexpr char kPoses[] = "truth: TUM, or MRPT's .GT.txt";

void addOutputs(CLI::App* verb, Arguments& arguments) {
  verb->add_option("-o,--output", arguments.output_folder, "folder for numbers.json and plots, created if missing");
  verb->add_option("--json", arguments.json_file, "file for the numbers as JSON");
}

CLI::App* addVerb(CLI::App& app, const std::string& name, const std::string& help, const std::string& reference,
                  Arguments& arguments) {
  CLI::App* verb = app.add_subcommand(name, help);
  verb->add_option("estimate", arguments.estimate, "trajectory to evaluate, TUM format")->required();
  verb->add_option("reference", arguments.reference, reference)->required();
  addOutputs(verb, arguments);
  verb->add_option("--tolerance", arguments.tolerance,
                   "largest difference between stamps that belong together [s]; default 0.01")
      ->check(omnimapper::program::notNegative());
  return verb;
}

void addPairing(CLI::App* verb, Arguments& arguments) {
  verb->add_option("--align", arguments.alignment,
                   "alignment of the trajectories: none, first, yaw, se3 or sim3; default none");
  verb->add_option("--interpolate", arguments.interpolate, "interpolate the reference over gaps up to this length [s]")
      ->check(omnimapper::program::positive());
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Measures the errors of a trajectory or a map against the truth.", "omnimapper-eval");
  addPairing(addOffset(addVerb(app, "ate", "absolute trajectory error", kPoses, arguments), arguments), arguments);
  CLI::App* rpe = addVerb(app, "rpe", "relative pose error", kPoses, arguments);
  addPairing(rpe, arguments);
  rpe->add_option("--delta", arguments.delta, "span over which motion is compared; default 1");
  rpe->add_option("--unit", arguments.unit, "unit of the delta: frames, s or m; default frames");
  addVerb(app, "relations", "metric of Kuemmerle et al. 2009 on manually checked relations", "relations", arguments)
      ->add_option("--base-from-sensor", arguments.base_from_sensor,
                   "pose of the relations' sensor on the base: x y [m] yaw [deg]")
      ->expected(3);
  CLI::App* map = app.add_subcommand("map", "compare the surfaces of a map with the true ones");
  map->add_option("map", arguments.estimate, "folder of a map, or its surfaces.json")->required();
  map->add_option("world", arguments.reference, "folder of the simulated log, or its surfaces.json")->required();
  addOutputs(map, arguments);
  map->add_option("--align", arguments.map_alignment,
                  "alignment by trajectory.tum and truth.tum in the folders: none, first, yaw or se3")
      ->capture_default_str();
  CLI::App* views =
      app.add_subcommand("views", "compare the surfaces of a map with the depth images of a log with known poses");
  views->add_option("map", arguments.estimate, "folder of a map, or its surfaces.json")->required();
  views->add_option("log", arguments.log, "log with depth images")->required();
  views->add_option("trajectory", arguments.reference, "poses of the base in that log: TUM")->required();
  addOutputs(views, arguments);
  views
      ->add_option("--align", arguments.map_alignment,
                   "alignment by trajectory.tum in the map's folder: none, first, yaw or se3")
      ->capture_default_str();
  views
      ->add_option("--tolerance", arguments.tolerance,
                   "largest difference between the stamps of an image and its pose [s]; default 0.01")
      ->check(omnimapper::program::notNegative());
  views->add_option("--interpolate", arguments.interpolate, "interpolate the poses over gaps up to this length [s]")
      ->check(omnimapper::program::positive());
  views
      ->add_option("--views", arguments.views,
                   "largest number of views; of more images only every second, fourth, ... is used")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  views->footer(
      "Example, a camera whose poses were measured by others:\n"
      "  omnimapper-import tum tum_fr3_cabinet58 cabinet.rawlog --poses\n"
      "  omnimapper-graphslam -i rgbd_planes.ini -r cabinet.rawlog -o out/cabinet\n"
      "  omnimapper-eval views out/cabinet cabinet.rawlog cabinet.truth.tum -o out/views\n"
      "With the map's own poses: omnimapper-eval views out/map LOG out/map/trajectory.tum");
  evaluation::addSeen(app, arguments);
  evaluation::addObjects(app, arguments);
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  omnimapper-eval ate out/trajectory.tum simul.rawlog.GT.txt --align se3 -o out/ate\n"
      "  omnimapper-eval rpe out/trajectory.tum groundtruth.tum --delta 1 --unit m\n"
      "  omnimapper-eval relations out/trajectory.tum aces.relations\n"
      "  omnimapper-eval map out/map out/home -o out/quality\n"
      "  omnimapper-eval views out/cabinet cabinet.rawlog cabinet.truth.tum -o out/views\n"
      "  omnimapper-eval seen out/home\n"
      "  omnimapper-eval objects out/map out/home\n"
      "Options of one verb: omnimapper-eval ate --help. Exit codes: doc/exit_codes.md.");
  return program::run(app, argc, argv,
                      [&] { return evaluation::run(app.get_subcommands().front()->get_name(), arguments); });
}
