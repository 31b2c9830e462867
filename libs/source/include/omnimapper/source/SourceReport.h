#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Stamp.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::source {

/// Counts of one sensor, that is, of the observations that were handed out with one label and one class.
struct SensorCounts {
  std::uint64_t observations = 0;
  std::uint64_t zero_stamps = 0;      ///< without a stamp
  std::uint64_t backward_stamps = 0;  ///< stamp before that of the sensor's previous observation
  base::Stamp first_stamp;            ///< of the first observation to arrive with a stamp; "no stamp" if none has one
  base::Stamp last_stamp;
};

/// Observations that are left out for one reason.
struct LeftOut {
  std::uint64_t observations = 0;
  base::Stamp first_stamp;  ///< of the first such observation, which may have no stamp
};

/// What was read of a stream of observations so far, and how it ended.
struct SourceReport {
  /// In order from good to bad.
  enum class Ending {
    open,                ///< not at its end yet
    complete,            ///< read to its end
    truncated,           ///< the file ends in the middle of something
    corrupt,             ///< something in it cannot be read
    unregistered_class,  ///< an object of a class that is not registered; it cannot be skipped, as its length is
                         ///< unknown
  };
  Ending ending = Ending::open;
  std::string message;             ///< for the user: file, place and remedy; empty if all is well
  std::string unregistered_class;  ///< name of the class that is not registered
  std::uint64_t objects = 0;       ///< objects (rawlog) or lines (text log) read whole
  std::uint64_t bytes = 0;         ///< of the uncompressed file, up to the end of the last such object or line

  std::map<std::pair<std::string, std::string>, SensorCounts> sensors;  ///< by (label, class)
  std::map<std::string, std::uint64_t> other_objects;                   ///< objects that are no observations, by class
  std::uint64_t repaired_stamps = 0;                                    ///< observations whose stamp was replaced
  std::uint64_t filtered_out = 0;         ///< observations without a wanted label or outside of the wanted time
  std::set<std::string> filtered_labels;  ///< labels of these observations
  std::uint64_t dropped_actions = 0;      ///< actions without a span of time, before the first or after the last frame
  /// Observations that cannot be used, by (label, reason as ObservationGate gives it).
  std::map<std::pair<std::string, std::string>, LeftOut> unusable;
  std::uint64_t missing_images = 0;  ///< observations left out because an external file cannot be read
  std::string first_missing_image;   ///< the first such file
  std::vector<std::string> notes;    ///< at the end: lines about the log that only its format has
  std::vector<std::string> doubts;   ///< at the end: sentences about what in the log is probably wrong
  bool has_logs_apart = false;       ///< one of several merged logs lies far from all others in time

  /// Observations handed out.
  std::uint64_t observations() const;
  std::uint64_t zeroStamps() const;
  std::uint64_t backwardStamps() const;
  /// Exit code of a program that reads this source: ok, damaged_input, unregistered_class or missing_images.
  base::ExitCode exitCode() const;
  /// A table of several lines for the user.
  std::string text() const;
  std::uint64_t unusableCount() const;
  /// One sentence for each sensor and reason.
  std::vector<std::string> unusableText() const;
  void countUnusable(const std::string& label, const std::string& reason, base::Stamp stamp);
  /// Counts one observation that is handed out.
  void count(const std::string& label, const std::string& class_name, base::Stamp stamp);
  /// Adds another source's counts and message. The ending becomes the worse of both; but if neither is bad and one is
  /// open, it becomes open.
  void add(const SourceReport& other);
};

std::string toString(SourceReport::Ending ending);

}  // namespace omnimapper::source
