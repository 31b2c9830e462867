#include "Verbs.h"

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/MapQuality.h>
#include <omnimapper/eval/Report.h>
#include <omnimapper/eval/TumFile.h>

#include <filesystem>
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

// A folder stands for the file in it.
std::string surfacesFile(const std::string& path) {
  return std::filesystem::is_directory(path) ? path + "/surfaces.json" : path;
}

// A file in the same folder.
std::string besideSurfaces(const std::string& path, const std::string& name) {
  return (std::filesystem::path(surfacesFile(path)).parent_path() / name).string();
}

// The surfaces of the map in the frame of the truth: the trajectories in both folders tell how that lies to the map's.
surfaces::SurfaceSet inTrueFrame(const surfaces::SurfaceSet& map, const Arguments& arguments) {
  const auto alignment = eval::alignmentNamed(arguments.alignment);
  if (alignment == eval::Alignment::none) return map;
  if (alignment == eval::Alignment::sim3)
    throw base::Error(base::ExitCode::command_line, "--align sim3: a map has its scale");
  const std::string estimate = besideSurfaces(arguments.estimate, "trajectory.tum");
  const std::string truth = besideSurfaces(arguments.reference, "truth.tum");
  for (const auto& file : {estimate, truth}) {
    if (std::filesystem::exists(file)) continue;
    throw base::Error(base::ExitCode::unreadable_input,
                      file +
                          ": is missing, and only trajectories tell how the frame of the map lies to the true one; "
                          "if it is the same, say --align none");
  }
  const auto paired =
      eval::pairTrajectories(eval::readTrajectory(estimate), eval::readTrajectory(truth),
                             {base::durationFromSeconds(arguments.tolerance), base::Duration(0), alignment});
  return surfaces::moved(map, paired.reference_from_estimate.motion);
}

int judgeMap(const Arguments& arguments) {
  const auto map = inTrueFrame(surfaces::readSurfaces(surfacesFile(arguments.estimate)), arguments);
  const auto truth = surfaces::readSurfaces(surfacesFile(arguments.reference));
  const auto quality = eval::judgeMap(map, truth);
  std::cout << eval::table(quality);
  if (!arguments.json_file.empty())
    base::writeFile(arguments.json_file, [&](std::ostream& out) { out << eval::json(quality, map, truth); });
  if (!arguments.output_folder.empty())
    eval::saveReport(arguments.output_folder, arguments.estimate, quality, map, truth);
  return 0;
}

}  // namespace

int run(const std::string& verb, const Arguments& arguments) {
  if (verb == "map") return judgeMap(arguments);
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
