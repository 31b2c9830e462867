#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/Report.h>
#include <omnimapper/eval/TumFile.h>

#include <iostream>

#include "program/Program.h"

namespace {

using namespace omnimapper;

struct Arguments {
  std::string estimate, reference, output_folder, json_file;
  double tolerance = 0.01, interpolate = 0;          // [s]
  std::vector<double> base_from_sensor = {0, 0, 0};  // x y [m] yaw [deg]
  std::string alignment = "none", unit = "frames";
  double delta = 1;
};

constexpr char kPoses[] = "truth: TUM, or MRPT's .GT.txt";

CLI::App* addVerb(CLI::App& app, const std::string& name, const std::string& help, const std::string& reference,
                  Arguments& arguments) {
  CLI::App* verb = app.add_subcommand(name, help);
  verb->add_option("estimate", arguments.estimate, "trajectory to be judged, TUM format")->required();
  verb->add_option("reference", arguments.reference, reference)->required();
  verb->add_option("-o,--output", arguments.output_folder, "folder for numbers.json and plots, made if missing");
  verb->add_option("--json", arguments.json_file, "file for the numbers");
  verb->add_option("--tolerance", arguments.tolerance, "between stamps that belong together [s], default 0.01")
      ->check(omnimapper::program::notNegative());
  return verb;
}

void addPairing(CLI::App* verb, Arguments& arguments) {
  verb->add_option("--align", arguments.alignment, "none, first, yaw, se3 or sim3; default none");
  verb->add_option("--interpolate", arguments.interpolate, "interpolate the reference over gaps up to this [s]")
      ->check(omnimapper::program::positive());
}

template <class Result, class... Reference>
int report(const Arguments& arguments, const Result& result, const Reference&... reference) {
  std::cout << eval::table(result);
  const auto write_json = [&](std::ostream& out) { out << eval::json(result); };
  if (!arguments.json_file.empty()) base::writeFile(arguments.json_file, write_json);
  if (!arguments.output_folder.empty()) {
    eval::saveReport(arguments.output_folder, arguments.estimate, result, reference...);
  }
  return 0;
}

int run(const std::string& verb, const Arguments& arguments) {
  const auto estimate = eval::readTrajectory(arguments.estimate);
  const auto tolerance = base::durationFromSeconds(arguments.tolerance);
  if (verb == "relations") {
    eval::RelationOptions options{tolerance, {}};
    const auto& pose = arguments.base_from_sensor;
    options.base_from_sensor = geometry::lift({pose[0], pose[1], pose[2] * geometry::kPi / 180});
    return report(arguments, eval::relationError(estimate, eval::readRelations(arguments.reference), options));
  }
  const auto reference = eval::readTrajectory(arguments.reference);
  const eval::PairingOptions pairing{tolerance, base::durationFromSeconds(arguments.interpolate),
                                     eval::alignmentNamed(arguments.alignment)};
  if (verb == "ate") {
    const auto error = eval::absoluteTrajectoryError(estimate, reference, pairing);
    std::cerr << eval::hintsOn(error, pairing.alignment);
    return report(arguments, error, reference);
  }
  return report(arguments, eval::relativePoseError(estimate, reference, pairing,
                                                   {arguments.delta, eval::deltaUnitNamed(arguments.unit)}));
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Says how far a trajectory is from the truth.", "omnimapper-eval");
  addPairing(addVerb(app, "ate", "absolute trajectory error", kPoses, arguments), arguments);
  CLI::App* rpe = addVerb(app, "rpe", "relative pose error", kPoses, arguments);
  addPairing(rpe, arguments);
  rpe->add_option("--delta", arguments.delta, "span over which motion is compared, default 1");
  rpe->add_option("--unit", arguments.unit, "of the delta: frames, s or m; default frames");
  addVerb(app, "relations", "metric of Kuemmerle et al. 2009 over relations checked by hand", "relations", arguments)
      ->add_option("--base-from-sensor", arguments.base_from_sensor, "x y [m] yaw [deg] of the relations' sensor")
      ->expected(3);
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  omnimapper-eval ate out/trajectory.tum simul.rawlog.GT.txt --align se3 -o out/ate\n"
      "  omnimapper-eval rpe out/trajectory.tum groundtruth.tum --delta 1 --unit m\n"
      "  omnimapper-eval relations out/trajectory.tum aces.relations\n"
      "Options of one verb: omnimapper-eval ate --help. Exit codes: doc/exit_codes.md.");
  return program::run(app, argc, argv, [&] { return run(app.get_subcommands().front()->get_name(), arguments); });
}
