#include <omnimapper/base/Error.h>
#include <omnimapper/map/Map.h>

namespace omnimapper::map {

const Landmark& Map::landmark(base::LandmarkId id) const {
  const Landmark* found = landmarks.find(id);
  while (found && found->state == Landmark::State::merged) found = landmarks.find(found->merged_into);
  if (!found) {
    throw base::Error(base::ExitCode::internal, "landmark " + toString(id) + " is not among the " +
                                                    std::to_string(landmarks.size()) + " landmarks of the map");
  }
  return *found;
}

}  // namespace omnimapper::map
