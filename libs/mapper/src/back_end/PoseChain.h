#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/plugin/Motion.h>
#include <omnimapper/plugin/PosePlugin.h>
#include <omnimapper/plugin/SessionStart.h>
#include <omnimapper/plugin/WatchesObservations.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::mapper {

/// The key frames of the current session and the continuous factors between neighbours in time (thesis 5.2.3). Between
/// two neighbours, each continuous source that covers the span has one factor, or the first fallback if no source does.
/// A key frame that comes late is spliced in: the factors across its stamp are replaced by two, and nothing else
/// changes.
class PoseChain {
 public:
  /// The caller owns `sources`, `map` and `graph`.
  PoseChain(Motion motion, const std::vector<Named<PosePlugin>>& sources, map::Map& map, graph::Graph& graph)
      : motion_(motion), sources_(sources), map_(map), graph_(graph) {}

  /// Must be called before the first key frame of a session. Without `start` the first pose is held at the map's
  /// origin, or only initialized there if `absolute` is set, because measurements then place it in the map.
  void beginSession(const map::Session& session, const std::optional<SessionStart>& start, bool absolute);

  struct Place {
    base::KeyFrameId id;
    bool is_new;  ///< false if there was already a key frame of that stamp
    std::optional<base::KeyFrameId> before, after;
  };
  /// Finds the key frame of that stamp or inserts a new one. None if no source has the motion to its neighbours.
  std::optional<Place> place(base::Stamp stamp);
  /// Adds a dependent frame for an observation of the reference sensor that is no key frame; it belongs to the key
  /// frame before it. False if there is no such key frame or no source has the motion from it.
  bool attach(base::Stamp stamp);
  /// Where the base was at that stamp; none if there is no key frame that is not younger, or if no source has the
  /// motion from it.
  std::optional<WatchedPose> at(base::Stamp stamp) const;
  /// Must be called when a source has new information on that span: the key frames there are linked again.
  void relink(base::Stamp begin, base::Stamp end);

  /// That key frame and those before it in the session are held (SlidingWindow): nothing links them any more, and a
  /// stamp before the next key frame has no place in the chain.
  void retire(base::KeyFrameId id);

  /// Stamp of the session's newest key frame; none before the first.
  std::optional<base::Stamp> newest() const;
  /// Stamp of the session's last key frame that is not after `stamp`.
  std::optional<base::Stamp> lastAtOrBefore(base::Stamp stamp) const;
  /// The motion of the first source that covers the span. Sources that do not measure are used only if `or_guess` is
  /// set.
  std::optional<RelativeMotion> motion(base::Stamp begin, base::Stamp end, bool or_guess) const;

 private:
  struct SpanMotions {
    std::vector<std::pair<std::string, RelativeMotion>> motions;  // with the section of the source
    bool by_guess = false;
  };
  struct Link {
    std::vector<base::FactorId> factors;
    bool by_guess = false;
  };
  SpanMotions motionBetween(base::Stamp begin, base::Stamp end, bool or_guess) const;
  std::uint16_t session() const { return map_.sessions.back().number; }
  const map::KeyFrame* frameBefore(base::Stamp stamp) const;
  const map::KeyFrame* frameAfter(base::Stamp stamp) const;
  map::KeyFrame newFrame(base::Stamp stamp, const mrpt::poses::CPose3D& map_from_base);
  void hold(base::VariableId first_pose);
  void link(base::KeyFrameId begin, base::KeyFrameId end, const SpanMotions& span);
  void unlink(base::KeyFrameId begin);
  void reattach(base::KeyFrameId begin, const std::vector<base::Stamp>& stamps);

  Motion motion_;
  const std::vector<Named<PosePlugin>>& sources_;
  map::Map& map_;
  graph::Graph& graph_;
  std::map<base::KeyFrameId, Link> links_;  // the link to the next key frame
  std::optional<SessionStart> start_;
  bool absolute_ = false;
  // The session's first pose is held by a factor or by being fixed.
  std::optional<base::FactorId> hold_;
  std::optional<base::VariableId> held_;
  std::optional<base::KeyFrameId> retired_;  // the last key frame that was retired
};

}  // namespace omnimapper::mapper
