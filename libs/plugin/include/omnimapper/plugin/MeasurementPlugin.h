#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/map/MapSection.h>
#include <omnimapper/perception/Blackboard.h>
#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/Job.h>
#include <omnimapper/plugin/View.h>

#include <memory>
#include <optional>

namespace omnimapper::mapper {

/// The layer with the saved state of a plugin is named by this prefix and the plugin's INI section.
inline constexpr char kPluginLayerPrefix[] = "plugin ";

/// The result of MeasurementPlugin::prepare() for one observation; each plugin derives its own type from it.
struct Prepared {
  virtual ~Prepared() = default;
};

struct Kinds;

/// One observation of a key frame, as it is passed to a measurement plugin.
struct Observed {
  const mrpt::obs::CObservation& observation;
  const Prepared* prepared;  ///< what the plugin's prepare() returned for it; may be null
};

/// Turns observations into factors (thesis 5.3.3). All functions but wants() and prepare() are called from one thread.
/// A plugin keeps the past observations that it needs.
class MeasurementPlugin {
 public:
  /// Registers the variables, factors, payloads and layers that the plugins of a class put into a map, so that a map
  /// file can be read. A class that has any hides this function by one of its own.
  static void registerKinds(Kinds& /*kinds*/) {}

  virtual ~MeasurementPlugin() = default;
  /// Whether the plugin uses this observation, raw or derived. The answer must depend only on the observation and the
  /// options. It is called from several threads.
  virtual bool wants(const mrpt::obs::CObservation& observation) const = 0;
  /// Whether the plugin works only on landmarks of other plugins: wants() then returns false for every observation.
  virtual bool worksOnLandmarks() const { return false; }
  /// Heavy work that needs only the observation and the options. It runs in several threads of the worker pool while
  /// the other functions run, so it must not read data that those change.
  virtual std::unique_ptr<const Prepared> prepare(const mrpt::obs::CObservation& /*observation*/) const { return {}; }
  /// What perception calls: prepare(), for plugins that use what others have made of the observation. `board` is the
  /// blackboard of the raw observation, which the observation is or was derived from.
  virtual std::unique_ptr<const Prepared> prepareUsing(const mrpt::obs::CObservation& observation,
                                                       const perception::Blackboard& /*board*/) const {
    return prepare(observation);
  }
  /// Whether the plugin's factors measure absolute poses in the map. The first pose is then not held at the origin.
  virtual bool givesAbsolutePoses() const { return false; }
  /// `frame` is linked to its neighbours already. It is the newest key frame unless the observation came late: then it
  /// may be a new one between older ones, or an older one, at which the plugin may have measured another observation of
  /// the same label.
  virtual Batch measure(const map::KeyFrame& frame, const Observed& observed, const View& view) = 0;
  /// Gets the final ids of what the plugin's last batch added, in order of addition. Also called for the batches of its
  /// jobs.
  virtual void applied(const AppliedBatch& /*ids*/) {}
  /// Called when a key frame left the window of a run that localizes: the plugin must not measure between it and
  /// another key frame any more.
  virtual void retired(const map::KeyFrame& /*frame*/) {}
  /// Called after all batches of `frame` were applied, and after the solve if there was one.
  virtual FollowUp afterCommit(const map::KeyFrame& /*frame*/, const View& /*view*/) { return {}; }
  /// Called at the end of the log, after the last solve, for edits that need the whole log. The graph is solved again
  /// if there are any edits.
  virtual Batch atEnd(const View& /*view*/) { return {}; }
  /// Called after atEnd(): the evidence of this plugin for or against the finished map.
  virtual std::vector<Evidence> evidence(const View& /*view*/) const { return {}; }

  /// Called after atEnd(), and when the plugin is removed from a run that goes on: sentences about what a user should
  /// know, such as that the base is not level.
  virtual std::vector<std::string> warnings() const { return {}; }

  /// What a map must keep of the plugin, for this plugin alone, so that a later session can continue; the engine names
  /// the layer. None if frames, landmarks and graph suffice. What other plugins, outputs or queries read is a layer of
  /// its own (Batch::setLayer()).
  virtual std::optional<map::MapSection> save() const { return std::nullopt; }
  /// Called once, before the first observation that the plugin gets, when a map is continued or the plugin is added to
  /// a run that goes on: restores what save() returned and what the plugin needs of the map. `saved` is null if the
  /// file has no section of the plugin. Throws Error(unreadable_input).
  virtual void restore(const map::MapSection* /*saved*/, const View& /*view*/) {}
};

}  // namespace omnimapper::mapper
