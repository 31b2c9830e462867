#include "DepthLog.h"

#include <omnimapper/base/Config.h>
#include <omnimapper/camera/CameraCalibration.h>
#include <omnimapper/camera/RgbdView.h>
#include <omnimapper/source/ReadAhead.h>
#include <omnimapper/source/openLogs.h>

#include <algorithm>

#include "../Outputs.h"

namespace omnimapper::calibration {

using mrpt::obs::CObservation3DRangeScan;

void DepthImageChooser::leaveOut(const std::string& why) {
  if (left_out_++ == 0) why_left_out_ = why;
}

void DepthImageChooser::add(const CObservation3DRangeScan& scan) {
  ++images_;
  // Planes are sought only in the depths, so a missing picture does not matter.
  CObservation3DRangeScan depths;
  depths.sensorLabel = scan.sensorLabel;
  depths.hasRangeImage = true;
  depths.rangeImage = scan.rangeImage;
  depths.rangeUnits = scan.rangeUnits;
  depths.range_is_depth = scan.range_is_depth;
  depths.cameraParams = scan.cameraParams;
  if (scan.rangeImage.size() == 0) {
    leaveOut("it has no pixels, or its file could not be read");
    return;
  }
  try {
    const camera::RgbdView view(depths);
    auto cells = cellsOf(view.depth());
    if (!last_.cells.empty() && (cells.width != last_.width || cells.height != last_.height)) {
      leaveOut("it has " + std::to_string(cells.width) + " x " + std::to_string(cells.height) + " pixels and not " +
               std::to_string(last_.width) + " x " + std::to_string(last_.height));
      return;
    }
    if (!last_.cells.empty() && !areDifferent(cells, last_)) return;
    last_ = std::move(cells);
  } catch (const base::Error& error) {
    leaveOut(error.what());
    return;
  }
  if (different_++ % stride_ != 0) return;
  kept_.push_back(last_);
  if (kept_.size() <= most_) return;
  std::vector<DepthCells> fewer;
  for (std::size_t i = 0; i < kept_.size(); i += 2) fewer.push_back(std::move(kept_[i]));
  kept_ = std::move(fewer);
  stride_ *= 2;
}

std::vector<DepthCells> DepthImageChooser::take() {
  return std::move(kept_);
}

namespace {

void readIniValues(const std::string& ini, const camera::CameraCalibration& known, DepthLog& log) {
  const auto config = base::Config::fromFile(ini);
  const auto section = config.section("calibration");
  for (const auto& spec : camera::CameraCalibrationOptions::table().specs()) {
    std::string text;
    if (spec.key == "label" || spec.key == "depth_distortion_per_m" || !section.find(spec.key, text)) continue;
    log.ini_values.emplace_back(spec.key, text);
  }
  log.ini_distortion = known.depthDistortion().coefficients();
}

[[noreturn]] void refuseLog(const DepthRequest& request, std::size_t scans, const DepthImageChooser& chooser,
                            const source::SourceReport& report) {
  const std::string of = request.label.empty() ? "" : " with the label '" + request.label + "'";
  std::string why = "there is no observation of a camera with depths" + of;
  if (scans > 0) why = "the camera's observations have no depth images";
  if (chooser.leftOut() > 0) why = "no depth image can be used, the first because " + chooser.whyLeftOut();
  throw base::Error(base::ExitCode::nothing_to_map, titleOf(request.logs) + ": " + why +
                                                        "; record them, or name another camera with --label; nothing "
                                                        "was written.\nWhat was read:\n" +
                                                        report.text());
}

}  // namespace

DepthLog readDepthLog(const DepthRequest& request, base::Progress& progress, const std::function<bool()>& stop) {
  camera::CameraCalibration known;
  if (!request.ini.empty()) known = camera::CameraCalibration::read(base::Config::fromFile(request.ini));
  source::SourceOptions options;
  options.start = request.start;
  options.end = request.end;
  source::ReadAhead log(source::openLogs(request.logs, options, stop), stop);
  DepthLog result;
  result.label = request.label;
  DepthImageChooser chooser(static_cast<std::size_t>(request.images));
  std::size_t scans = 0;
  while (const auto observation = log.next()) {
    if (stop()) break;
    progress.report(0.85 * log.progress(), "looking for planes");
    const auto scan = std::dynamic_pointer_cast<CObservation3DRangeScan>(observation);
    if (!scan || (!result.label.empty() && scan->sensorLabel != result.label)) continue;
    ++scans;
    if (!scan->hasRangeImage) continue;
    result.label = scan->sensorLabel;
    if (known.isOf(scan->sensorLabel)) {
      if (result.ini_values.empty() && result.ini_distortion.empty()) readIniValues(request.ini, known, result);
      const auto units = static_cast<double>(scan->rangeUnits);
      known.applyTo(*scan);  // the log's own copy is not needed any more
      result.ini_scale = static_cast<double>(scan->rangeUnits) / units;
    }
    chooser.add(*scan);
  }
  if (stop()) throw base::Error(base::ExitCode::interrupted, "interrupted; nothing was written");
  result.report = log.report();
  if (chooser.images() == chooser.leftOut()) refuseLog(request, scans, chooser, result.report);
  result.scans = chooser.images();
  result.left_out = chooser.leftOut();
  result.why_left_out = chooser.whyLeftOut();
  result.images = chooser.take();
  return result;
}

}  // namespace omnimapper::calibration
