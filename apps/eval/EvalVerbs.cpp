#include "EvalVerbs.h"

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/eval/Report.h>
#include <omnimapper/eval/TumFile.h>

#include <iostream>

namespace omnimapper::evaluation {

namespace {

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

}  // namespace

int run(const std::string& verb, const Arguments& arguments) {
  if (verb == "map") return judgeMap(arguments);
  if (verb == "views") return judgeByViews(arguments);
  if (verb == "seen") return countSeen(arguments);
  if (verb == "objects") return judgeObjects(arguments);
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

}  // namespace omnimapper::evaluation
