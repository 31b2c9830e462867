#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/TumLine.h>
#include <omnimapper/source/ExternalImages.h>
#include <omnimapper/source/RawlogWriter.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "Imports.h"

using namespace omnimapper;

namespace {

// The pose of the base at that time, if the folder tells one so near.
mrpt::obs::CObservationRobotPose::Ptr poseAt(const source::RgbdFolder& images, base::Stamp stamp, double tolerance) {
  const auto& truth = images.groundTruth();
  auto nearest = std::lower_bound(truth.begin(), truth.end(), stamp,
                                  [](const auto& pose, base::Stamp wanted) { return pose.first < wanted; });
  const auto off = [&](const auto& pose) { return std::abs(base::secondsBetween(pose->first, stamp)); };
  if (nearest == truth.end() || (nearest != truth.begin() && off(std::prev(nearest)) < off(nearest))) {
    if (nearest == truth.begin()) return nullptr;
    --nearest;
  }
  if (off(nearest) > tolerance) return nullptr;
  auto pose = mrpt::obs::CObservationRobotPose::Create();
  pose->timestamp = stamp;
  pose->sensorLabel = "poses";
  pose->pose.mean = geometry::toMrpt(nearest->second);
  return pose;
}

}  // namespace

base::ExitCode importRgbd(const std::string& folder, const std::string& output,
                          const source::RgbdFolderOptions& options, bool external_images, bool poses) {
  source::RgbdFolder images(folder, options);
  const std::string stem = std::filesystem::path(output).replace_extension().string(), truth = stem + ".truth.tum";
  base::TerminalProgress progress(std::cerr, isatty(STDERR_FILENO) != 0);
  const auto fill = [&](source::RawlogWriter& rawlog) {
    while (const auto observation = images.next()) {
      if (external_images) {
        base::makeWritableFolder(stem + "_Images");
        source::moveImagesToFiles(*observation, stem + "_Images",
                                  options.label + "_" + base::formatUnix(observation->timestamp, 6));
      }
      if (const auto pose = poses ? poseAt(images, observation->timestamp, options.largest_difference) : nullptr)
        rawlog.add(*pose);
      rawlog.add(*observation);
      progress.report(images.progress(), "importing " + folder);
    }
    refuseNothing(folder, images.report());
  };
  source::writeRawlog(output, fill, source::ColourImages::jpeg);
  if (!images.groundTruth().empty()) {
    base::writeFile(truth, [&](std::ostream& out) {
      for (const auto& [stamp, world_from_base] : images.groundTruth())
        out << geometry::tumLine(stamp, world_from_base);
    });
  }
  std::cout << images.report().text() << "depth images without a colour image of their time: " << images.unpaired()
            << "\n";
  if (!images.groundTruth().empty())
    std::cout << "ground truth of the base (x forward, z up): " << truth << ", " << images.groundTruth().size()
              << " poses\n";
  return images.report().exitCode();
}
