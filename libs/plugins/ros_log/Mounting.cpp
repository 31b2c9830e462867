#include "Mounting.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>

namespace omnimapper::ros {

std::string Mounting::mount(const Waiting& waiting, const Transforms& transforms) {
  geometry::Se3 base_from_frame;
  const std::string &base = plan_.baseFrame(), &frame = waiting.measured.frame;
  if (waiting.role != Role::pose && (base.empty() || frame != base)) {
    const std::string root = transforms.chainFrom(frame).back();
    const bool is_connected = !base.empty() && transforms.connects(base, frame);
    if (is_connected || (frame != root && isBaseFrame(root))) {
      const std::string& from = is_connected ? base : root;
      const auto found = transforms.between(from, frame, waiting.time, kHeldBack);
      if (!found) return "no transform from " + from + " to " + frame + " at that time";
      base_from_frame = *found;
      if (!is_connected) other_bases_.insert(root);
    } else {
      if (unmounted_.size() < kMostNamed) unmounted_.insert(waiting.sensor);
      const bool is_optical = waiting.role == Role::image || frame.find("optical") != std::string::npos;
      if (is_optical) base_from_frame = geometry::sensorFromOptical();
    }
  }
  waiting.measured.observation->setSensorPose(geometry::toMrpt(base_from_frame * waiting.measured.frame_from_sensor));
  return "";
}

void Mounting::addTo(source::SourceReport& report) const {
  noteUnmounted(report);
  for (const auto& frame : other_bases_)
    report.notes.push_back("no transform connects " + frame + " with the base " + plan_.baseFrame() +
                           "; they are taken to be the same");
}

// One sensor at a wrong place only moves the base; several contradict each other.
void Mounting::noteUnmounted(source::SourceReport& report) const {
  std::string names;
  for (const auto& sensor : unmounted_)
    names += (names.empty() ? "" : ", ") + plan_.labelOf(sensor) + " (frame '" + sensor.second + "')";
  if (names.empty()) return;
  auto& lines = unmounted_.size() > 1 ? report.doubts : report.notes;
  lines.push_back(
      "the log does not say where on the robot these sensors are mounted, as no transform in tf connects their frames "
      "with the base; they are taken to be at the base, looking ahead: " +
      names + (unmounted_.size() < kMostNamed ? "" : ", and perhaps more") +
      "; their poses can be set for [mapper] sensors");
}

}  // namespace omnimapper::ros
