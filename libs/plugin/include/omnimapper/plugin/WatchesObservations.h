#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/Id.h>
#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/RelativeMotion.h>
#include <omnimapper/plugin/View.h>

#include <optional>
#include <vector>

namespace omnimapper::mapper {

/// Where the base was when an observation was made.
struct WatchedPose {
  base::KeyFrameId frame;              ///< the newest key frame that is not younger than the observation
  RelativeMotion frame_from_base;      ///< the motion of the base since then, with its covariance
  mrpt::poses::CPose3D map_from_base;  ///< as estimated now
};

/// One observation as a watcher gets it.
struct Watched {
  const mrpt::obs::CObservation& observation;
  std::optional<WatchedPose> pose;  ///< none before the first key frame, or if no pose plugin knows the motion
};

/// The answer of a watcher to an observation.
struct WatchResult {
  Batch batch;  ///< such as factors on WatchedPose::frame, or a layer of the map
  /// New observations, which the engine takes as if they had arrived now: they may become key frames, and watchers see
  /// them, too. They are not recorded, because a replay makes them again.
  std::vector<mrpt::obs::CObservation::Ptr> observations;
};

/// A measurement plugin that implements this interface, too, sees every observation of the kinds that it watches, also
/// those that make no key frame: a gesture or a command beside a robot that stands still. All functions but watches()
/// are called from the thread of the engine.
class WatchesObservations {
 public:
  virtual ~WatchesObservations() = default;
  /// Depends only on the observation and the options.
  virtual bool watches(const mrpt::obs::CObservation& observation) const = 0;
  /// Called on arrival, in the order of arrival and before the observation waits for those of slower sensors. It must
  /// not take long. If the observation is too late for the map, or the plugin is removed meanwhile, watch() does not
  /// follow; for a plugin that was added meanwhile, watch() comes without this.
  virtual void arrived(const mrpt::obs::CObservation& /*observation*/) {}
  /// Called in the order of stamps, except for late observations, and after the observations of the same stamp became
  /// part of the map. What the answer adds to the graph is solved with the next key frame.
  virtual WatchResult watch(const Watched& watched, const View& view) = 0;
};

/// A measurement plugin that implements this interface, too, hears of every observation on arrival, whether any plugin
/// wants it or not. What it hears does not wait in the queue and makes no key frame.
class HearsObservations {
 public:
  virtual ~HearsObservations() = default;
  /// Called from the thread of the engine, in the order of arrival, with the sensor poses that [mapper] sensors gives
  /// applied. It must not take long.
  virtual void heard(const mrpt::obs::CObservation& observation) = 0;
};

}  // namespace omnimapper::mapper
