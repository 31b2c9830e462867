#include <omnimapper/map/SessionMetrics.h>

namespace omnimapper::map {

std::vector<SessionMetrics> sessionMetrics(const Map& map) {
  std::vector<SessionMetrics> all;
  const KeyFrame *first = nullptr, *before = nullptr;
  for (const KeyFrame& frame : map.key_frames) {
    if (!before || before->id.session != frame.id.session) {
      all.push_back({frame.id.session, 0, 0, 0});
      first = &frame;
    } else {
      all.back().travel += (frame.map_from_base.translation() - before->map_from_base.translation()).norm();
    }
    const base::Stamp last = frame.dependents.empty() ? frame.stamp : frame.dependents.back().stamp;
    all.back().seconds = base::secondsBetween(first->stamp, last);
    ++all.back().key_frames;
    before = &frame;
  }
  return all;
}

}  // namespace omnimapper::map
