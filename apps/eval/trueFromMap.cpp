#include "trueFromMap.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/eval/Pairing.h>
#include <omnimapper/eval/TumFile.h>

#include <filesystem>

namespace omnimapper::evaluation {

geometry::Se3 trueFromMap(const Arguments& arguments, const std::string& trajectory, const std::string& truth) {
  const auto alignment = eval::alignmentNamed(arguments.map_alignment);
  if (alignment == eval::Alignment::none) return {};
  if (alignment == eval::Alignment::sim3)
    throw base::Error(base::ExitCode::command_line, "--align sim3: a map has its scale");
  for (const auto& file : {trajectory, truth}) {
    if (std::filesystem::exists(file)) continue;
    throw base::Error(base::ExitCode::unreadable_input,
                      file +
                          ": is missing, but the frame of the map can only be aligned to the true one by trajectories; "
                          "if both frames are the same, use --align none");
  }
  const auto paired = eval::pairTrajectories(
      eval::readTrajectory(trajectory), eval::readTrajectory(truth),
      {base::durationFromSeconds(arguments.tolerance), base::durationFromSeconds(arguments.interpolate), alignment});
  return paired.reference_from_estimate.motion;
}

}  // namespace omnimapper::evaluation
