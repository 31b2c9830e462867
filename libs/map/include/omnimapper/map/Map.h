#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/Id.h>
#include <omnimapper/base/Stamp.h>

#include <string>
#include <vector>

namespace omnimapper::map {

/// An observation of the reference sensor between two key frames: it hangs on the key frame before it.
struct HangingFrame {
  base::Stamp stamp;
  mrpt::poses::CPose3D keyframe_from_base;  ///< motion since the key frame, by the continuous pose source
};

/// A pose of the base that the graph optimises, with what was seen from there.
struct KeyFrame {
  base::KeyFrameId id;
  base::Stamp stamp;
  base::VariableId pose;                                        ///< its variable in the graph
  mrpt::poses::CPose3D map_from_base;                           ///< latest estimate
  std::vector<mrpt::obs::CObservation::ConstPtr> observations;  ///< raw and derived, all of `stamp`; sensor frames
  std::vector<HangingFrame> hanging;                            ///< in order of stamp, before the next key frame
  /// Motion to the next key frame by the source that gave `hanging`; identity for the newest.
  mrpt::poses::CPose3D keyframe_from_next;
};

/// What is known of the place, in plain data. Lengths [m], angles [rad].
struct Map {
  std::vector<KeyFrame> key_frames;  ///< in order of stamp

  /// The key frame of that id. Throws Error(internal) if there is none.
  const KeyFrame& keyFrame(base::KeyFrameId id) const;
  /// Index of the last key frame at or before `stamp`; -1 if all are later.
  int indexAt(base::Stamp stamp) const;
};

struct StampedPose {
  base::Stamp stamp;
  mrpt::poses::CPose3D map_from_base;
};

/// One pose for each key frame and each hanging frame, in order of stamp. Between two key frames the disagreement of
/// the continuous source with the optimised poses is spread evenly in time, so that the path has no steps.
std::vector<StampedPose> denseTrajectory(const Map& map);

}  // namespace omnimapper::map
