#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/MapQuality.h>
#include <omnimapper/eval/Pairing.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/eval/ViewAgreement.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>

#include "EvalVerbs.h"
#include "program/Program.h"

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
  auto map = surfaces::readSurfaces(surfacesFile(arguments.estimate));
  const auto alignment = eval::alignmentNamed(arguments.alignment);
  if (alignment == eval::Alignment::none) return map;
  if (alignment == eval::Alignment::sim3)
    throw base::Error(base::ExitCode::command_line, "--align sim3: a map has its scale");
  const std::string estimate = besideSurfaces(arguments.estimate, "trajectory.tum");
  for (const auto& file : {estimate, truth}) {
    if (std::filesystem::exists(file)) continue;
    throw base::Error(base::ExitCode::unreadable_input,
                      file +
                          ": is missing, but the frame of the map can only be aligned to the true one by trajectories; "
                          "if both frames are the same, use --align none");
  }
  const auto paired = eval::pairTrajectories(
      eval::readTrajectory(estimate), eval::readTrajectory(truth),
      {base::durationFromSeconds(arguments.tolerance), base::durationFromSeconds(arguments.interpolate), alignment});
  return surfaces::moved(map, paired.reference_from_estimate.motion);
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
  reportSurfaces(arguments, eval::judgeMap(map, truth), map, truth);
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
