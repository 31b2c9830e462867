#include "copyLog.h"

#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/source/ExternalImages.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>

#include "program/Program.h"

using namespace omnimapper;

namespace {

mrpt::obs::CObservationRobotPose poseObservation(base::Stamp stamp, const geometry::Se3& true_pose) {
  mrpt::obs::CObservationRobotPose pose;
  pose.timestamp = stamp;
  pose.sensorLabel = "poses";
  pose.pose.mean = geometry::toMrpt(true_pose);
  return pose;
}

}  // namespace

std::size_t copyLog(source::ObservationSource& log, const Arguments& arguments, source::RawlogWriter& rawlog) {
  base::TerminalProgress progress(std::cerr, isatty(STDERR_FILENO) != 0);
  const std::string images = std::filesystem::path(arguments.output).replace_extension().string() + "_Images";
  std::size_t posed = 0;
  while (const auto observation = log.next()) {
    if (arguments.images == "external") {
      base::makeWritableFolder(images);
      source::moveImagesToFiles(*observation, images,
                                observation->sensorLabel + "_" + base::formatUnix(observation->timestamp, 6));
    }
    if (const auto truth = arguments.poses ? log.truthAt(observation->timestamp) : std::nullopt) {
      rawlog.add(poseObservation(observation->timestamp, *truth));
      ++posed;
    }
    rawlog.add(*observation);
    if (program::isInterrupted()) throw base::Error(base::ExitCode::interrupted, "interrupted; no rawlog was written");
    progress.report(log.progress(), "importing " + arguments.input);
  }
  const auto report = log.report();
  if (report.observations() == 0)
    throw base::Error(base::ExitCode::unreadable_input,
                      arguments.input +
                          ": contains nothing that can be imported; nothing was written.\nWhat was read:\n" +
                          report.text());
  if (arguments.poses && posed == 0)
    throw base::Error(
        base::ExitCode::unreadable_input,
        arguments.input + " has no true pose at the time of any observation, for --poses; nothing was written");
  return posed;
}
