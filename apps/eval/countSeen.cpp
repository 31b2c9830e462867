#include <omnimapper/base/AtomicFile.h>

#include <iostream>

#include "EvalVerbs.h"
#include "program/Program.h"

namespace omnimapper::evaluation {

void addSeenLimits(CLI::App* verb, Arguments& arguments) {
  verb->add_option("--pixels", arguments.pixels,
                   "smallest number of pixels that show an object in an image that counts")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000000));
  verb->add_option("--images", arguments.images, "smallest number of such images of an object that counts as seen")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000000));
  verb->add_option("--distance", arguments.distance, "farthest mean distance of an object in such an image [m]")
      ->check(program::positive());
}

eval::SeenLimits seenLimits(const Arguments& arguments) {
  eval::SeenLimits limits;
  limits.pixels = arguments.pixels;
  limits.images = arguments.images;
  if (arguments.distance > 0) limits.distance = arguments.distance;
  return limits;
}

void addSeen(CLI::App& app, Arguments& arguments) {
  CLI::App* verb = app.add_subcommand("seen", "count how often the camera images of a simulated log show each object");
  verb->add_option("world", arguments.reference, "folder of the simulated log")->required();
  verb->add_option("--json", arguments.json_file, "file for the numbers as JSON");
  addSeenLimits(verb, arguments);
}

int countSeen(const Arguments& arguments) {
  const auto objects = eval::readTrueObjects(arguments.reference);
  const auto seen =
      eval::countSightings(objects, eval::readObjectSightings(arguments.reference), seenLimits(arguments));
  std::cout << eval::table(seen, objects);
  if (!arguments.json_file.empty())
    base::writeFile(arguments.json_file, [&](std::ostream& out) { out << eval::json(seen, objects); });
  return 0;
}

}  // namespace omnimapper::evaluation
