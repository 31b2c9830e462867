#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/eval/MapQuality.h>
#include <omnimapper/eval/ThingQuality.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/eval/ViewAgreement.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>

#include "EvalVerbs.h"
#include "program/Program.h"
#include "trueFromMap.h"

namespace omnimapper::evaluation {

namespace {

// The path itself, or for a folder its surfaces.json.
std::string surfacesFile(const std::string& path) {
  return std::filesystem::is_directory(path) ? path + "/surfaces.json" : path;
}

// A file in the same folder as the surfaces.
std::string besideSurfaces(const std::string& path, const std::string& name) {
  return (std::filesystem::path(surfacesFile(path)).parent_path() / name).string();
}

// The surfaces of the map in the true frame, aligned by the trajectory beside them and the true one.
surfaces::SurfaceSet inTrueFrame(const Arguments& arguments, const std::string& truth) {
  return surfaces::moved(surfaces::readSurfaces(surfacesFile(arguments.estimate)),
                         trueFromMap(arguments, besideSurfaces(arguments.estimate, "trajectory.tum"), truth));
}

template <class Result, class... Sets>
void reportSurfaces(const Arguments& arguments, const Result& result, const Sets&... sets) {
  std::cout << eval::table(result);
  if (!arguments.json_file.empty())
    base::writeFile(arguments.json_file, [&](std::ostream& out) { out << eval::json(result, sets...); });
  if (!arguments.output_folder.empty()) eval::saveReport(arguments.output_folder, arguments.estimate, result, sets...);
}

}  // namespace

int judgeMap(const Arguments& arguments) {
  const auto map = inTrueFrame(arguments, besideSurfaces(arguments.reference, "truth.tum"));
  const auto truth = surfaces::readSurfaces(surfacesFile(arguments.reference));
  const auto quality = eval::judgeMap(map, truth);
  reportSurfaces(arguments, quality, map, truth);
  std::cout << eval::table(eval::judgeThings(quality, map, truth));
  return 0;
}

int judgeByViews(const Arguments& arguments) {
  program::listenForInterrupts();
  const auto map = inTrueFrame(arguments, arguments.reference);
  eval::ViewOptions options;
  options.tolerance = base::durationFromSeconds(arguments.tolerance);
  options.longest_gap = base::durationFromSeconds(arguments.interpolate);
  options.most_views = arguments.views;
  eval::LogViews views;
  {
    base::TerminalProgress progress(std::cerr, isatty(STDERR_FILENO) != 0);
    views = eval::readViews(arguments.log, eval::readTrajectory(arguments.reference), options, progress,
                            program::isInterrupted);
  }
  if (!views.message.empty()) std::cerr << "omnimapper-eval: warning: " << views.message << "\n";
  std::cout << views.posed << " of " << views.images << " depth images have a pose\n";
  reportSurfaces(arguments, eval::judgeByViews(map, views.views), map);
  return static_cast<int>(views.code);
}

}  // namespace omnimapper::evaluation
