#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// The counts and times of a run on live sensors, for its summary.
struct LiveMetrics {
  struct Sensor {
    std::string name;   ///< name of its section
    std::string state;  ///< "working", "silent" or "lost"
    std::uint64_t observations = 0;
    double clock_offset = 0;  ///< [s] that was added to its stamps
    std::uint64_t clock_jumps = 0;
    std::uint64_t reopened = 0;  ///< how often it sent data again after it was silent or lost
    std::uint64_t left_out = 0;  ///< invalid messages or lines, which were discarded
  };
  std::vector<Sensor> sensors;
  /// Each observation that arrived was either given to the mapper, or dropped for a newer frame of its camera, or not
  /// kept because the disk was too slow, or unusable.
  std::uint64_t arrived = 0, given = 0, dropped = 0, not_kept = 0, unusable = 0;
  double latency_median = 0, latency_99 = 0;  ///< [s] from the stamp of an observation to its key frame in the map
  std::vector<std::string> recording;         ///< paths of the files, relative to the output folder
  std::uint64_t recorded = 0;                 ///< observations
  std::uint64_t recorded_bytes = 0;           ///< before they are compressed
  std::uint64_t bytes_on_disk = 0;
  double recorder_seconds = 0;  ///< time that compressing and writing took
};

}  // namespace omnimapper::mapper
