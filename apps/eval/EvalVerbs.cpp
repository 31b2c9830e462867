#include "EvalVerbs.h"

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/eval/FixedOffset.h>
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

// The clocks are compared between the poses of the reference, so it is interpolated.
eval::Trajectory withoutOffset(const eval::Trajectory& estimate, const eval::Trajectory& reference,
                               eval::PairingOptions& pairing) {
  constexpr double kUsualGap = 0.2;  // [s]
  if (pairing.longest_gap <= base::Duration(0)) pairing.longest_gap = base::durationFromSeconds(kUsualGap);
  const auto offset = eval::fitFixedOffset(estimate, reference, pairing.longest_gap);
  std::cout << eval::describe(offset);
  return eval::withOffset(estimate, offset);
}

}  // namespace

CLI::App* addOffset(CLI::App* verb, Arguments& arguments) {
  verb->add_flag(
      "--solve-offset", arguments.solves_offset,
      "solve for one fixed pose of the reference's part on the body and one fixed offset of its clock, print "
      "them, and judge the trajectory without them; for motion capture");
  return verb;
}

int run(const std::string& verb, const Arguments& arguments) {
  if (verb == "map") return judgeMap(arguments);
  if (verb == "views") return judgeByViews(arguments);
  if (verb == "seen") return countSeen(arguments);
  if (verb == "objects") return judgeObjects(arguments);
  auto estimate = eval::readTrajectory(arguments.estimate);
  const auto tolerance = base::durationFromSeconds(arguments.tolerance);
  if (verb == "relations") {
    eval::RelationOptions options{tolerance, {}};
    const auto& pose = arguments.base_from_sensor;
    options.base_from_sensor = geometry::lift({pose[0], pose[1], pose[2] * geometry::kPi / 180});
    return report(arguments, eval::relationError(estimate, eval::readRelations(arguments.reference), options));
  }
  const auto reference = eval::readTrajectory(arguments.reference);
  eval::PairingOptions pairing{tolerance, base::durationFromSeconds(arguments.interpolate),
                               eval::alignmentNamed(arguments.alignment)};
  if (verb == "ate") {
    if (arguments.solves_offset) estimate = withoutOffset(estimate, reference, pairing);
    const auto error = eval::absoluteTrajectoryError(estimate, reference, pairing);
    std::cerr << eval::hintsOn(error, pairing.alignment);
    return report(arguments, error, reference);
  }
  return report(arguments, eval::relativePoseError(estimate, reference, pairing,
                                                   {arguments.delta, eval::deltaUnitNamed(arguments.unit)}));
}

}  // namespace omnimapper::evaluation
