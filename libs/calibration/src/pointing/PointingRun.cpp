#include <mrpt/obs/CObservationSkeleton.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/base/OutputFolder.h>
#include <omnimapper/calibration/PointingRun.h>
#include <omnimapper/interaction/PointingTarget.h>
#include <omnimapper/source/ReadAhead.h>
#include <omnimapper/source/openLogs.h>

#include <map>

#include "../Outputs.h"
#include "PointedGestures.h"
#include "PointingReport.h"

namespace omnimapper::calibration {

namespace {

using interaction::PointingSample;

/// The skeletons of one gesture that were found in the log.
struct Found {
  std::size_t frames = 0;
  std::vector<PointingSample> samples;
  std::string why_not;  ///< of the last skeleton that is of no use
};

bool isDuring(const PointedGesture& gesture, const Found& found, base::Stamp stamp) {
  if (stamp < gesture.begin) return false;
  if (gesture.end != base::Stamp()) return stamp <= gesture.end;
  // Without an end, a gesture that is hardly seen must not take skeletons of the next one.
  constexpr double kLongest = 10;  // [s]
  return found.frames < kFramesOfGesture && base::secondsBetween(gesture.begin, stamp) <= kLongest;
}

void addSkeleton(const PointedGesture& gesture, const mrpt::obs::CObservationSkeleton& skeleton,
                 const interaction::SkeletonFormat& format, Found& found) {
  ++found.frames;
  const auto reading = interaction::readBody(skeleton, format);
  if (!reading.body) {
    found.why_not = reading.why_not;
    return;
  }
  const auto& arm = reading.body->arm(gesture.is_right_arm);
  const auto isSeen = [](const std::optional<interaction::BodyJoint>& joint) { return joint && !joint->is_guessed; };
  if (!isSeen(arm.hand) || !isSeen(arm.elbow) || !isSeen(reading.body->head)) {
    found.why_not = "hand, elbow and head are not all seen";
    return;
  }
  interaction::PointingGesture rays;
  rays.is_right_arm = gesture.is_right_arm;
  rays.hand = arm.hand->at;
  rays.elbow = arm.elbow->at;
  rays.head = reading.body->head->at;
  rays.sensor = reading.body->sensor;
  const auto errors = interaction::errorsOf(rays, gesture.target_in_base);
  found.samples.push_back({gesture.person, gesture.target, interaction::directionOf(rays, gesture.target_in_base),
                           *errors.elbow_hand, *errors.head_hand});
}

std::vector<PointingSample> samplesOf(const PointingRequest& request, const std::vector<PointedGesture>& gestures,
                                      base::Progress& progress, const std::function<bool()>& stop,
                                      std::vector<std::string>& warnings) {
  source::ReadAhead log(source::openLogs(request.logs, {}, stop), stop);
  std::vector<Found> found(gestures.size());
  while (const auto observation = log.next()) {
    if (stop()) break;
    progress.report(log.progress(), "reading skeletons");
    const auto* skeleton = dynamic_cast<const mrpt::obs::CObservationSkeleton*>(observation.get());
    if (!skeleton || (!request.label.empty() && skeleton->sensorLabel != request.label)) continue;
    for (std::size_t i = 0; i < gestures.size(); ++i)
      if (isDuring(gestures[i], found[i], skeleton->timestamp))
        addSkeleton(gestures[i], *skeleton, request.format, found[i]);
  }
  if (stop()) throw base::Error(base::ExitCode::interrupted, "interrupted; nothing was written");
  std::vector<PointingSample> samples;
  for (std::size_t i = 0; i < gestures.size(); ++i) {
    samples.insert(samples.end(), found[i].samples.begin(), found[i].samples.end());
    if (!found[i].samples.empty()) continue;
    const std::string what = request.gestures + ":" + std::to_string(i + 2) + ": " +
                             base::printable(gestures[i].person) + " points at '" +
                             base::printable(gestures[i].target) + "', but ";
    if (found[i].frames == 0)
      throw base::Error(base::ExitCode::unreadable_input,
                        what + "no log has a skeleton at that time; is begin_s a time of its clock?");
    warnings.push_back(what + "of " + base::counted(found[i].frames, "skeleton") +
                       " none is of use: " + found[i].why_not);
  }
  return samples;
}

}  // namespace

CalibrationResult runPointingCalibration(const PointingRequest& request, base::Progress& progress,
                                         const std::function<bool()>& stop) {
  refuseFolderOfMap(request.output);
  const base::InputsKept inputs_kept(request.logs);
  const auto gestures = readPointedGestures(request.gestures);
  base::OutputFolder folder(request.output);
  folder.open();
  CalibrationResult result;
  const auto samples = samplesOf(request, gestures, progress, stop, result.warnings);
  const auto fit = interaction::fitPointing(samples);
  result.is_better = true;
  result.text = pointingReport(fit, samples.size(), titleOf(request.logs));
  for (const auto& warning : pointingWarnings(fit)) result.warnings.push_back(warning);
  const auto write = [&](const std::string& name, const auto& writer) {
    base::writeFile(folder.staging() + "/" + name, writer);
  };
  write("pointing.csv", [&](std::ostream& out) { out << interaction::tableOf(fit.model); });
  write("report.txt", [&](std::ostream& out) { out << result.text; });
  write("pointing.svg", [&](std::ostream& out) { drawPointing(samples, out); });
  folder.commit();
  return result;
}

}  // namespace omnimapper::calibration
