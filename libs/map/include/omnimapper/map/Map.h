#pragma once

#include <omnimapper/base/IdTable.h>
#include <omnimapper/map/KeyFrames.h>
#include <omnimapper/map/Landmark.h>
#include <omnimapper/map/Layers.h>

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::map {

/// One run that added to the map. The ids of everything that this run added contain the number of its session.
struct Session {
  std::uint16_t number = 0;
  std::string title;        ///< name of its log
  base::VariableId anchor;  ///< map_from_session: where the session began, as estimated now
  bool aligned = true;      ///< a measurement ties it to the first session; true for the first session itself
  std::optional<base::KeyFrameId> aligned_at = std::nullopt;  ///< the key frame whose measurement tied it, if any
};

/// The map as plain data. Lengths are in [m] and angles in [rad]. Copies are cheap (base::IdTable).
struct Map {
  KeyFrames key_frames;
  base::IdTable<base::LandmarkId, Landmark> landmarks;
  std::vector<Session> sessions;  ///< in order of number
  Layers layers;                  ///< all other data, such as the level, the place on earth and the state of plugins

  /// The key frame of that id. Throws Error(internal) if there is none.
  const KeyFrame& keyFrame(base::KeyFrameId id) const { return key_frames.at(id); }
  /// The landmark of that id, or the one it was merged into. Throws Error(internal) if there is none.
  const Landmark& landmark(base::LandmarkId id) const;
};

}  // namespace omnimapper::map
