#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/Id.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/map/CloudPoint.h>

#include <vector>

namespace omnimapper::map {

/// An observation of the reference sensor between two key frames: its pose follows from the key frame before it.
struct DependentFrame {
  base::Stamp stamp;
  mrpt::poses::CPose3D keyframe_from_base;  ///< motion since the key frame, as the pose source measured it
};

/// A pose of the base that the graph optimizes, with what was seen from there.
struct KeyFrame {
  base::KeyFrameId id;
  base::Stamp stamp;
  base::VariableId pose;               ///< its variable in the graph
  mrpt::poses::CPose3D map_from_base;  ///< latest estimate
  /// Raw and derived observations of `stamp`, in sensor frames. They keep only those images that an output asks for.
  std::vector<mrpt::obs::CObservation::ConstPtr> observations;
  std::vector<CloudPoint> cloud;           ///< points of its depth images where the map had no point yet
  std::vector<DependentFrame> dependents;  ///< in order of stamp, before the next key frame
  /// Motion to the next key frame, from the same pose source as `dependents`; identity for the newest key frame.
  mrpt::poses::CPose3D keyframe_from_next;
  bool reference = true;  ///< the reference sensor saw something here: the trajectory has a line for it
};

}  // namespace omnimapper::map
