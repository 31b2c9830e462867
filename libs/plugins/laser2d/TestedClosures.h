#pragma once

#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/View.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace omnimapper::plugins {

/// The closures of this run and the results of their consistency tests.
class TestedClosures {
 public:
  /// Adds a key frame at which a closure may begin or end.
  void add(const map::KeyFrame& frame) { stamp_of_[frame.pose] = frame.stamp; }
  /// Adds factors between key frames that the engine has applied.
  void add(const std::vector<base::FactorId>& factors);
  /// Notes the number of solves so far: all closures that were there before the last solve have been tested. To be
  /// called once for each key frame.
  void noteSolves(std::size_t solves);

  /// Stamp of the newest key frame that an accepted closure ties to the map; none without an accepted closure.
  std::optional<base::Stamp> newestTied(const graph::Graph& graph) const;
  /// Stamp of the newest key frame at which a closure with this note ends, whether the closure was accepted or not;
  /// none without such a closure.
  std::optional<base::Stamp> newestWithNote(const graph::Graph& graph, const std::string& note) const;
  /// Closures of global searches that were tested and refused.
  std::vector<base::FactorId> refusedGlobally(const graph::Graph& graph) const;
  /// Closures between a session and others, accepted or not.
  std::vector<base::FactorId> between(std::uint16_t session, const graph::Graph& graph) const;
  /// Proposes all refused global closures again, once after each solve with a newly corrected motion; else empty.
  mapper::Batch proposedAgain(const mapper::State& state, const std::string& section);
  /// How many motions were corrected so far.
  std::size_t corrections() const { return corrections_; }

 private:
  struct Closure {
    base::FactorId id;
    bool is_tested;
    bool is_settled;  // for the factor of a corrected motion: the refused closures were proposed again
  };
  std::optional<base::Stamp> stampOf(const graph::FactorRecord& record) const;

  std::vector<Closure> closures_;
  std::unordered_map<base::VariableId, base::Stamp> stamp_of_;  // by the pose of the key frame
  std::size_t solves_ = 0, corrections_ = 0;
};

}  // namespace omnimapper::plugins
