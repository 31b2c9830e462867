#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::live {

/// One action of a live run on its recording. A replay that does the same actions in the same order makes the same map.
struct JournalEvent {
  enum class Kind {
    add,     ///< an observation was given to the mapper
    drop,    ///< an observation was left out because of a newer one of its camera
    bundle,  ///< the mapper began to work on the oldest bundle whose perception was done
    job      ///< the mapper took the oldest job
  };
  Kind kind = Kind::add;
  std::uint64_t number = 0;  ///< of the observation, among the usable ones of the recording, from 0 on

  bool operator==(const JournalEvent& other) const { return kind == other.kind && number == other.number; }
};

/// Writes a journal, NAME.journal beside the rawlogs NAME.rawlog, NAME_001.rawlog and so on. Not thread-safe.
class JournalWriter {
 public:
  /// Throws Error(unwritable_output) if the file cannot be made.
  explicit JournalWriter(const std::string& path);
  void add(const JournalEvent& event);
  /// Passes all events to the operating system, so that they survive if this process is killed. False if the file
  /// cannot be written any more.
  bool flush();

 private:
  std::ofstream file_;
};

/// A journal and the rawlogs of its recording.
struct Journal {
  std::vector<JournalEvent> events;
  std::vector<std::string> rawlogs;  ///< paths, in their order

  /// Reads a journal up to its last whole line; its writer may have been killed. Throws Error(unreadable_input), naming
  /// file and line, for a file that is no journal, or whose first rawlog is not beside it.
  static Journal read(const std::string& path);
};

/// The journal that a path names: that file, or the only journal in that folder or in its folder `recording`. Throws
/// Error(unreadable_input) for a folder with none, or with several, which it names.
std::string findJournal(const std::string& path);

/// The path of the INI of the live run that wrote this journal, TIME.ini beside TIME.journal.
std::string iniOf(const std::string& journal);

/// That INI, if it exists. Throws Error(unreadable_input) if it does not begin with base::kWrittenFromALog: it would be
/// trusted with plugin libraries, and a recording may come from anybody.
std::optional<std::string> findIni(const std::string& journal);

}  // namespace omnimapper::live
