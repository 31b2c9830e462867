#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/eval/ObjectMapQuality.h>

#include <iostream>

#include "EvalVerbs.h"
#include "trueFromMap.h"

namespace omnimapper::evaluation {

void addObjects(CLI::App& app, Arguments& arguments) {
  CLI::App* verb = app.add_subcommand("objects", "compare the objects of a map with those of its simulated log");
  verb->add_option("map", arguments.estimate, "folder of a map with objects.json")->required();
  verb->add_option("world", arguments.reference, "folder of the simulated log")->required();
  verb->add_option("--json", arguments.json_file, "file for the numbers as JSON");
  verb->add_option("--curve", arguments.curve_file,
                   "file for a CSV table of precision and recall by the number of images that show an object");
  verb->add_option("--align", arguments.map_alignment,
                   "alignment by trajectory.tum and truth.tum in the folders: none, first, yaw or se3")
      ->capture_default_str();
  addSeenLimits(verb, arguments);
  verb->footer(
      "An object is sought in the map if enough images show enough of it at the place where it is at the end.\n"
      "Example: omnimapper-eval objects out/map out/atrium --json out/objects.json");
}

int judgeObjects(const Arguments& arguments) {
  const auto truth = eval::readObjectTruth(arguments.reference);
  const auto map =
      moved(eval::readObjectMap(arguments.estimate),
            trueFromMap(arguments, arguments.estimate + "/trajectory.tum", arguments.reference + "/truth.tum"));
  eval::ObjectMapOptions options;
  options.seen = seenLimits(arguments);
  const auto quality = eval::judgeObjects(map, truth, options);
  std::cout << eval::table(quality, map, truth);
  if (!arguments.json_file.empty())
    base::writeFile(arguments.json_file, [&](std::ostream& out) { out << eval::json(quality, map, truth); });
  if (!arguments.curve_file.empty())
    base::writeFile(arguments.curve_file, [&](std::ostream& out) { out << eval::curveTable(quality); });
  return 0;
}

}  // namespace omnimapper::evaluation
