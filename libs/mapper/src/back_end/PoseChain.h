#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/plugin/Motion.h>
#include <omnimapper/plugin/PosePlugin.h>
#include <omnimapper/plugin/SessionStart.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::mapper {

/// The key frames of the running session and the continuous factors that link each to the next (thesis 5.2.3): between
/// neighbours in time, and only there, each continuous source that covers the span has one factor, or the first
/// fallback if none does. A key frame that comes late is spliced in: the factors across its stamp are replaced by two,
/// and nothing else changes.
class PoseChain {
 public:
  /// `sources`, `map` and `graph` stay the caller's.
  PoseChain(Motion motion, const std::vector<Named<PosePlugin>>& sources, map::Map& map, graph::Graph& graph)
      : motion_(motion), sources_(sources), map_(map), graph_(graph) {}

  /// Before the first key frame of a session. Without `start` the first pose is held at the map's origin, or left to
  /// measurements if these are `absolute`: they say where in the map the base is.
  void beginSession(const map::Session& session, const std::optional<SessionStart>& start, bool absolute);

  struct Place {
    base::KeyFrameId id;
    bool is_new;  ///< false: there was a key frame of that stamp
    std::optional<base::KeyFrameId> before, after;
  };
  /// The key frame of that stamp: the one there is, or a new one in its place. None if no source tells the motion to
  /// its neighbours.
  std::optional<Place> place(base::Stamp stamp);
  /// An observation of the reference sensor that is no key frame: becomes a dependent frame of the key frame before it.
  /// False if there is none, or no source tells the motion from it.
  bool attach(base::Stamp stamp);
  /// A source tells other than before of that span: what links the key frames there is made anew.
  void relink(base::Stamp begin, base::Stamp end);

  /// That key frame of the session and those before it are held (SlidingWindow): nothing links them any more, and a
  /// stamp before the next one has no place in the chain.
  void retire(base::KeyFrameId id);

  /// Stamp of the session's newest key frame; none before the first.
  std::optional<base::Stamp> newest() const;
  /// Stamp of the session's last key frame that is not after `stamp`.
  std::optional<base::Stamp> lastAtOrBefore(base::Stamp stamp) const;
  /// What the first source that covers the span says; those that do not measure are asked if `or_guess`.
  std::optional<RelativeMotion> motion(base::Stamp begin, base::Stamp end, bool or_guess) const;

 private:
  struct SpanMotions {
    std::vector<std::pair<std::string, RelativeMotion>> motions;  // by section of the source
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
  std::map<base::KeyFrameId, Link> links_;  // to the next key frame
  std::optional<SessionStart> start_;
  bool absolute_ = false;
  // What holds the session's first pose: a factor, or that it is fixed.
  std::optional<base::FactorId> hold_;
  std::optional<base::VariableId> held_;
  std::optional<base::KeyFrameId> retired_;  // the last one
};

}  // namespace omnimapper::mapper
