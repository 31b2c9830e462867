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

/// What one sensor gave: the observations handed out under one label by one class.
struct SensorCounts {
  std::uint64_t observations = 0;
  std::uint64_t zero_stamps = 0;      ///< without a stamp
  std::uint64_t backward_stamps = 0;  ///< stamp before that of the sensor's previous observation
  base::Stamp first_stamp;            ///< of those with one, in order of arrival; "no stamp" if there is none
  base::Stamp last_stamp;
};

/// Observations that are left out for one reason.
struct LeftOut {
  std::uint64_t observations = 0;
  base::Stamp first_stamp;  ///< of the first of them; it may have none
};

/// How a stream of observations went so far, and how it ended.
struct SourceReport {
  /// From good to bad.
  enum class Ending {
    open,                ///< not at its end yet
    complete,            ///< read to its end
    truncated,           ///< the file ends in the middle of something
    corrupt,             ///< there is something that cannot be read
    unregistered_class,  ///< an object of a class that nobody registered: it cannot be skipped, its length is unknown
  };
  Ending ending = Ending::open;
  std::string message;             ///< one sentence for people: file, place, remedy; empty if all is well
  std::string unregistered_class;  ///< its name
  std::uint64_t objects = 0;       ///< objects (rawlog) or lines (text log) read whole
  std::uint64_t bytes = 0;         ///< of the uncompressed file, up to the end of the last of them

  std::map<std::pair<std::string, std::string>, SensorCounts> sensors;  ///< by (label, class)
  std::map<std::string, std::uint64_t> other_objects;                   ///< things that are no observation, by class
  std::uint64_t repaired_stamps = 0;      ///< observations that got a stamp which was not their own
  std::uint64_t filtered_out = 0;         ///< observations outside of the wanted labels and times
  std::set<std::string> filtered_labels;  ///< of these
  std::uint64_t dropped_actions = 0;      ///< actions that span nothing: before the first or after the last frame
  /// What nothing can be made of, by (label, reason as ObservationGate says it).
  std::map<std::pair<std::string, std::string>, LeftOut> unusable;
  std::uint64_t missing_images = 0;  ///< observations left out because an external file cannot be read
  std::string first_missing_image;   ///< the first such file
  bool has_logs_apart = false;       ///< of merged logs, one lies in time far from all others

  /// Observations handed out.
  std::uint64_t observations() const;
  std::uint64_t zeroStamps() const;
  std::uint64_t backwardStamps() const;
  /// What the program that reads this source should end with: ok, damaged_input, unregistered_class, missing_images.
  base::ExitCode exitCode() const;
  /// A table for people, some lines.
  std::string text() const;
  std::uint64_t unusableCount() const;
  /// One sentence for each sensor and reason.
  std::vector<std::string> unusableText() const;
  void countUnusable(const std::string& label, const std::string& reason, base::Stamp stamp);
  /// Counts one observation that is handed out.
  void count(const std::string& label, const std::string& class_name, base::Stamp stamp);
  /// Adds another source's counts and message. The ending becomes the worse of both, or open if that is good and one
  /// of them is open.
  void add(const SourceReport& other);
};

std::string toString(SourceReport::Ending ending);

}  // namespace omnimapper::source
