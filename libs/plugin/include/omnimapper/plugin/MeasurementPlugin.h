#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/Job.h>
#include <omnimapper/plugin/View.h>

#include <memory>
#include <optional>

namespace omnimapper::mapper {

/// A section of a map file with this before a plugin's INI section is that plugin's.
inline constexpr char kPluginSectionPrefix[] = "plugin ";

/// What a plugin made of an observation in the worker pool; a plugin derives its own from it.
struct Prepared {
  virtual ~Prepared() = default;
};

/// One observation of a key frame, as a measurement plugin gets it.
struct Observed {
  const mrpt::obs::CObservation& observation;
  const Prepared* prepared;  ///< what the plugin's prepare() made of it; null if that was nothing
};

/// Turns observations into factors (thesis 5.3.3). One thread calls it, wants() and prepare() apart; it keeps what it
/// needs of what it has seen.
class MeasurementPlugin {
 public:
  virtual ~MeasurementPlugin() = default;
  /// Whether this observation, raw or derived, is of its kind. Depends on nothing but the observation and the options;
  /// called from several threads.
  virtual bool wants(const mrpt::obs::CObservation& observation) const = 0;
  /// Whether it works on the landmarks of others alone: wants() says no to everything then.
  virtual bool worksOnLandmarks() const { return false; }
  /// Heavy work that needs nothing but the observation and the options. Runs in the worker pool, in several threads,
  /// while the other functions run: it must not read what they change.
  virtual std::unique_ptr<const Prepared> prepare(const mrpt::obs::CObservation& /*observation*/) const { return {}; }
  /// Whether its factors say where in the map the base is. The first pose is then not held at the origin.
  virtual bool givesAbsolutePoses() const { return false; }
  /// `frame` is linked to its neighbours already. It is the newest key frame, unless the observation came late: then
  /// spliced() was called before. A late observation may also be the second of its label at a key frame of old.
  virtual Batch measure(const map::KeyFrame& frame, const Observed& observed, const View& view) = 0;
  /// The final ids of what its last batch added, in the order it was added. Also called for the batches of its jobs.
  virtual void applied(const AppliedBatch& /*ids*/) {}
  /// A late key frame was put in its place in the trajectory: the continuous factor between its neighbours is replaced
  /// by two. `before` or `after` is none at the ends.
  virtual void spliced(const map::KeyFrame& /*frame*/, std::optional<base::KeyFrameId> /*before*/,
                       std::optional<base::KeyFrameId> /*after*/) {}
  /// A key frame left the window of a run that localizes: nothing may be measured between it and another any more.
  virtual void retired(const map::KeyFrame& /*frame*/) {}
  /// After all batches of `frame` were applied, and after the solve if there was one.
  virtual FollowUp afterCommit(const map::KeyFrame& /*frame*/, const View& /*view*/) { return {}; }
  /// At the end of the log, after the last solve: what only the whole of it tells. The graph is solved again if this is
  /// any edit.
  virtual Batch atEnd(const View& /*view*/) { return {}; }
  /// After that: what it can say for or against the finished map.
  virtual std::vector<Evidence> evidence(const View& /*view*/) const { return {}; }

  /// What a map file keeps of it so that a later session can go on; the name of the section is the engine's. None if
  /// frames, landmarks and graph say it all.
  virtual std::optional<map::MapSection> save() const { return std::nullopt; }
  /// Called once, before the first observation, when a map is continued: takes up what save() gave and what it needs of
  /// the sessions before. `saved` is null if the file has no section of it. Throws Error(unreadable_input).
  virtual void restore(const map::MapSection* /*saved*/, const View& /*view*/) {}
};

}  // namespace omnimapper::mapper
