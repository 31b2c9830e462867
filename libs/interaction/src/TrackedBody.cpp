#include <omnimapper/interaction/TrackedBody.h>

namespace omnimapper::interaction {

std::optional<Eigen::Vector3d> middleOf(const TrackedBody& body) {
  for (const auto* joint : {&body.torso, &body.neck, &body.head, &body.right.shoulder, &body.left.shoulder})
    if (*joint) return (*joint)->at;
  return std::nullopt;
}

bool looksAway(const TrackedBody& body) {
  if (!body.left.shoulder || !body.right.shoulder) return false;
  const Eigen::Vector3d to_left = body.left.shoulder->at - body.right.shoulder->at;
  const Eigen::Vector3d to_sensor = body.sensor - body.right.shoulder->at;
  // Whoever looks along f has its left at z x f.
  return to_left.x() * -to_sensor.y() + to_left.y() * to_sensor.x() < 0;
}

}  // namespace omnimapper::interaction
