#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <queue>
#include <vector>

#include "Converted.h"
#include "Survey.h"

namespace omnimapper::ros {

/// A measurement that waits for transforms and for earlier measurements that are recorded later.
struct Waiting {
  Converted measured;
  SensorKey sensor;
  std::size_t channel = 0;
  Role role = Role::other;
  std::int64_t time = 0, recorded = 0;  ///< [ns since 1970]
  std::uint64_t number = 0;             ///< in the order of the log
  std::size_t bytes = 0;                ///< of its message
  std::optional<Message> image = {};    ///< becomes an observation only when it is due
};

/// Holds measurements back for half a second of recording, and hands them out in the order of their times.
class ReorderBuffer {
 public:
  void add(Waiting waiting);
  /// The time of recording that the log has reached.
  void reach(std::int64_t recorded) { reached_ = recorded > reached_ ? recorded : reached_; }
  /// The log has ended: nothing is held back any more.
  void finish() { reached_ = std::numeric_limits<std::int64_t>::max(); }
  /// The next measurement; none before more of the log is read.
  std::optional<Waiting> next();

 private:
  struct Later {
    bool operator()(const Waiting& a, const Waiting& b) const {
      return a.time != b.time ? a.time > b.time : a.number > b.number;
    }
  };
  std::priority_queue<Waiting, std::vector<Waiting>, Later> waiting_;
  std::int64_t reached_ = std::numeric_limits<std::int64_t>::min();
  std::uint64_t bytes_ = 0;
};

/// How long measurements are held back [ns].
inline constexpr std::int64_t kHeldBack = 500'000'000;

}  // namespace omnimapper::ros
