#pragma once

#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/View.h>

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace omnimapper::plugins {

/// The closures of this run, and what the consistency test made of them.
class TestedClosures {
 public:
  /// A key frame that a closure may begin or end at.
  void add(const map::KeyFrame& frame) { stamp_of_[frame.pose] = frame.stamp; }
  /// Factors between key frames that the engine has taken.
  void add(const std::vector<base::FactorId>& factors);
  /// Takes note of the solves so far: what was there before the last one has been tested. Once for each key frame.
  void noteSolves(std::size_t solves);

  /// Stamp of the newest key frame that a closure ties to the map; of one with that note, whether it acts or not. None
  /// without such a closure.
  std::optional<base::Stamp> newestTied(const graph::Graph& graph) const;
  std::optional<base::Stamp> newestWithNote(const graph::Graph& graph, const std::string& note) const;
  /// Closures of global searches that were tested and do not act.
  std::vector<base::FactorId> refusedGlobally(const graph::Graph& graph) const;
  /// Proposes every refused global closure again, once, when the map is solved with a corrected motion; else empty.
  mapper::Batch proposedAgain(const mapper::State& state, const std::string& section);
  /// How many motions were corrected so far.
  std::size_t corrections() const { return corrections_; }

 private:
  struct Closure {
    base::FactorId id;
    bool is_tested;
    bool is_settled;  // of a corrected motion: what it was found by has been proposed again
  };
  std::optional<base::Stamp> stampOf(const graph::FactorRecord& record) const;

  std::vector<Closure> closures_;
  std::unordered_map<base::VariableId, base::Stamp> stamp_of_;  // by the pose of the key frame
  std::size_t solves_ = 0, corrections_ = 0;
};

}  // namespace omnimapper::plugins
