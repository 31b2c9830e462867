#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/WorkerPool.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/perception/Extractor.h>

#include <deque>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// The result of one extractor for one observation, or its error.
struct Outcome {
  bool wanted = false;
  bool unchanged = false;  ///< repeated from the previous observation, because this one shows nothing new
  std::vector<mrpt::obs::CObservation::Ptr> derived;
  std::optional<base::Error> error;
};

/// Runs the extractors on consecutive observations, several at once, and returns the results in order. If an
/// extractor's Novelty finds nothing new in an observation, it gets the result of the last new one with its own stamp.
class PerceptionLine {
 public:
  struct Perceived {
    mrpt::obs::CObservation::Ptr raw;
    std::vector<Outcome> outcomes;  ///< by extractor
  };

  /// The caller owns `extractors`.
  PerceptionLine(const std::vector<Named<perception::Extractor>>& extractors, int threads);

  bool isFull() const { return items_.size() >= depth_; }
  bool isEmpty() const { return items_.empty(); }
  void add(const mrpt::obs::CObservation::Ptr& raw);
  /// The oldest observation that was not taken yet; waits for its results.
  Perceived take();

 private:
  enum class Task { none, extract, repeat };
  struct Item {
    mrpt::obs::CObservation::Ptr raw;
    std::vector<Task> tasks;                     // by extractor
    std::future<std::vector<Outcome>> outcomes;  // by extractor
  };
  using Extractors = std::vector<Named<perception::Extractor>>;

  static Outcome outcomeOf(const perception::Extractor& extractor, const mrpt::obs::CObservation& raw,
                           perception::Blackboard& board);
  static Outcome repeated(const Outcome& earlier, const mrpt::obs::CObservation& raw);

  const Extractors& extractors_;
  std::vector<std::unique_ptr<perception::Novelty>> novelties_;  // by extractor
  std::vector<std::map<std::string, Outcome>> last_;             // by extractor with a novelty and by sensor
  const std::size_t depth_;
  std::deque<Item> items_;
  base::WorkerPool pool_;
};

}  // namespace omnimapper::mapper
