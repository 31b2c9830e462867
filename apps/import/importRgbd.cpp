#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/TumLine.h>
#include <omnimapper/source/ExternalImages.h>
#include <omnimapper/source/RawlogWriter.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "Imports.h"

using namespace omnimapper;

namespace {

mrpt::obs::CObservationRobotPose poseObservation(base::Stamp stamp, const geometry::Se3& world_from_base) {
  mrpt::obs::CObservationRobotPose pose;
  pose.timestamp = stamp;
  pose.sensorLabel = "poses";
  pose.pose.mean = geometry::toMrpt(world_from_base);
  return pose;
}

void refuseWithoutPoses(const source::RgbdFolder& images, const std::string& folder, double tolerance) {
  const auto& pairs = images.pairs();
  const auto is_known = [&](const source::RgbdPair& pair) { return images.truthAt(pair.stamp, tolerance).has_value(); };
  if (std::any_of(pairs.begin(), pairs.end(), is_known)) return;
  const std::string why =
      images.groundTruth().empty()
          ? "has no ground truth (groundtruth.txt, truth_cam_poses.txt, frame-*.pose.txt)"
          : "has no true pose within " + base::fixed(tolerance, 3) + " s of any image (--tolerance)";
  throw base::Error(base::ExitCode::unreadable_input, folder + " " + why + " for --poses; nothing was written");
}

// With wrong depth units or a wrong camera the map is wrong although it looks right, so they are printed.
void printCamera(const source::RgbdFolder& images) {
  const auto& camera = images.camera();
  std::cout << "camera: " << images.cameraName() << ", fx " << base::fixed(camera.fx(), 1) << " fy "
            << base::fixed(camera.fy(), 1) << " cx " << base::fixed(camera.cx(), 1) << " cy "
            << base::fixed(camera.cy(), 1) << " pixels\ndepth: " << images.depthUnits() << " units per metre";
  const auto depth = images.medianDepth();
  std::cout << (depth ? ", median " + base::fixed(*depth, 2) + " m" : ", no pixel has a depth") << "\n";
  // A Kinect measures from 0.8 m to 4 m, or from 0.4 m to 3 m in its near mode, and the median depth of a room is
  // seldom outside. freiburg1_rpy and freiburg3_cabinet read with 1000 units per metre have medians of 5.4 m and 7.2 m,
  // ICL-NUIM's living room with 5000 one of 0.35 m.
  constexpr double kNearest = 0.4, kFarthest = 4;  // [m]
  if (!depth || (*depth >= kNearest && *depth <= kFarthest)) return;
  std::cerr << "omnimapper-import: warning: half of the depths are " << (*depth < kNearest ? "below " : "above ")
            << base::fixed(*depth, 2) << " m: is --depth-units " << images.depthUnits()
            << " right? An RGB-D camera sees rooms at 0.4 m to 4 m; with wrong units the map has a wrong scale\n";
}

}  // namespace

base::ExitCode importRgbd(const std::string& folder, const std::string& output,
                          const source::RgbdFolderOptions& options, bool external_images, bool poses) {
  source::RgbdFolder images(folder, options);
  if (poses) refuseWithoutPoses(images, folder, options.largest_difference);
  const std::string stem = std::filesystem::path(output).replace_extension().string(), truth = stem + ".truth.tum";
  std::size_t posed = 0;
  ImportProgress progress(folder);
  const auto fill = [&](source::RawlogWriter& rawlog) {
    while (const auto observation = images.next()) {
      if (external_images) {
        base::makeWritableFolder(stem + "_Images");
        source::moveImagesToFiles(*observation, stem + "_Images",
                                  options.label + "_" + base::formatUnix(observation->timestamp, 6));
      }
      const auto truth_there = images.truthAt(observation->timestamp, options.largest_difference);
      if (poses && truth_there) {
        rawlog.add(poseObservation(observation->timestamp, *truth_there));
        ++posed;
      }
      rawlog.add(*observation);
      progress.report(images.progress());
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
  std::cout << images.report().text()
            << "depth images without a colour image at their time, kept without colour: " << images.unpaired() << "\n";
  printCamera(images);
  if (poses) std::cout << "images with a true pose in the rawlog: " << posed << "\n";
  if (!images.groundTruth().empty())
    std::cout << "ground truth of the base (x forward, z up): " << truth << ", " << images.groundTruth().size()
              << " poses\n";
  return images.report().exitCode();
}
