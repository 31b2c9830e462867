#include "CalibrationLog.h"

#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/camera/CameraCalibration.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/motion/WheelOdometry.h>
#include <omnimapper/source/ReadAhead.h>
#include <omnimapper/source/openLogs.h>

#include <algorithm>
#include <map>
#include <optional>

#include "ViewChooser.h"

namespace omnimapper::calibration {

namespace {

using mrpt::obs::CObservation3DRangeScan;

std::string joined(const std::vector<std::string>& logs) {
  std::string all;
  for (const auto& log : logs) all += (all.empty() ? "" : " + ") + log;
  return all;
}

/// Distance in metres that the base moved between two stamps, from wheels or given poses.
class Metres {
 public:
  Metres() : wheels_({}) {}

  void add(const mrpt::obs::CObservation& observation) {
    const auto* pose = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation);
    if (pose) given_[observation.timestamp] = geometry::fromMrpt(pose->pose.mean).translation;
    if (!pose) wheels_.add(observation);
  }
  bool areWheels() const { return given_.empty(); }

  /// Each span ends at the first view that is far enough from its first one.
  std::vector<MetricSpan> spansOf(const std::vector<CalibrationView>& views) const {
    constexpr double kFixed = 0.005, kOfWheels = 0.03, kWheelsScale = 0.01;  // [m] [-]
    const double far_enough = areWheels() ? 0.3 : 0.08;  // [m] longer for wheels, which slip at every start
    std::vector<MetricSpan> spans;
    for (std::size_t i = 0; i < views.size(); ++i) {
      for (std::size_t j = i + 1; j < views.size() && views[j].stretch == views[i].stretch; ++j) {
        const auto distance = between(views[i].stamp, views[j].stamp);
        if (!distance || *distance < far_enough) continue;
        spans.push_back(
            {i, j, *distance, kFixed + (areWheels() ? kOfWheels * *distance : 0), areWheels() ? kWheelsScale : 0});
        break;
      }
    }
    return spans;
  }

 private:
  std::optional<double> between(base::Stamp begin, base::Stamp end) const {
    if (areWheels()) {
      const auto motion = wheels_.between(begin, end);
      return motion ? std::optional<double>(motion->begin_from_end.translation().norm()) : std::nullopt;
    }
    const auto from = givenAt(begin), to = givenAt(end);
    return from && to ? std::optional<double>((*to - *from).norm()) : std::nullopt;
  }

  std::optional<Eigen::Vector3d> givenAt(base::Stamp stamp) const {
    constexpr double kLongestGap = 0.2;  // [s]
    const auto after = given_.lower_bound(stamp);
    if (after == given_.end()) return std::nullopt;
    if (after->first == stamp) return after->second;
    if (after == given_.begin()) return std::nullopt;
    const auto before = std::prev(after);
    const double gap = base::secondsBetween(before->first, after->first);
    if (gap > kLongestGap) return std::nullopt;
    const double share = base::secondsBetween(before->first, stamp) / gap;
    return before->second + share * (after->second - before->second);
  }

  std::map<base::Stamp, Eigen::Vector3d> given_;  // of the base [m]
  motion::WheelOdometry wheels_;
};

[[noreturn]] void refuse(const CalibrationRequest& request, const std::string& why,
                         const source::SourceReport& report) {
  throw base::Error(base::ExitCode::nothing_to_map,
                    joined(request.logs) + ": " + why + "; nothing was written.\nWhat was read:\n" + report.text());
}

/// Counts of the observations of the camera with depths.
struct ObservationCounts {
  std::size_t scans = 0, with_depth = 0, with_picture = 0;
};

std::string whyNone(const ObservationCounts& counts, const CalibrationRequest& request) {
  const std::string of = request.label.empty() ? "" : " with the label '" + request.label + "'";
  if (counts.scans == 0) return "there is no observation of a camera with depths" + of;
  if (counts.with_depth == 0) return "the camera's observations have no depth images";
  if (counts.with_picture == 0)
    return "the camera's observations have no pictures of 8 bits in which to find corners; record depths and pictures";
  return "the camera has a lens that cannot be refined (fisheye, or more than five coefficients) or no calibration to "
         "start from; give one in an INI with [calibration] (--ini)";
}

}  // namespace

CalibrationLog readCalibrationLog(const CalibrationRequest& request, base::Progress& progress,
                                  const std::function<bool()>& stop) {
  camera::CameraCalibration known;
  if (!request.ini.empty()) known = camera::CameraCalibration::read(base::Config::fromFile(request.ini));
  source::SourceOptions options;
  options.start = request.start;
  options.end = request.end;
  source::ReadAhead log(source::openLogs(request.logs, options, stop), stop);
  CalibrationLog result;
  result.label = request.label;
  ViewChooser chooser(static_cast<std::size_t>(request.views));
  Metres metres;
  ObservationCounts counts;
  while (const auto observation = log.next()) {
    if (stop()) break;
    progress.report(0.8 * log.progress(), "following the camera");
    const auto scan = std::dynamic_pointer_cast<CObservation3DRangeScan>(observation);
    if (!scan) {
      metres.add(*observation);
      continue;
    }
    if (!result.label.empty() && scan->sensorLabel != result.label) continue;
    ++counts.scans;
    counts.with_depth += scan->hasRangeImage;
    if (!scan->hasRangeImage || !scan->hasIntensityImage) continue;
    ++counts.with_picture;
    result.label = scan->sensorLabel;
    if (known.isOf(scan->sensorLabel)) {
      const auto units = static_cast<double>(scan->rangeUnits);
      known.applyTo(*scan);  // the log's own copy is not needed any more
      result.is_corrected = true;
      result.depth_distortion = known.depthDistortion().coefficients();
      result.corrected_scale = static_cast<double>(scan->rangeUnits) / units;
    }
    chooser.add(scan);
    if (chooser.isFull()) {
      result.is_part = true;
      break;
    }
  }
  if (stop()) throw base::Error(base::ExitCode::interrupted, "interrupted; nothing was written");
  result.report = log.report();
  if (!chooser.camera() && chooser.leftOut() > 0) refuse(request, chooser.whyLeftOut(), result.report);
  if (!chooser.camera()) refuse(request, whyNone(counts, request), result.report);
  result.camera = *chooser.camera();
  result.images = chooser.images();
  result.lost = chooser.lost();
  result.left_out = chooser.leftOut();
  result.why_left_out = chooser.whyLeftOut();
  result.travel = chooser.travel();
  result.turn = chooser.turn();
  result.views = chooser.take();
  result.spans = metres.spansOf(result.views);
  result.are_wheels = metres.areWheels() && !result.spans.empty();
  return result;
}

}  // namespace omnimapper::calibration
