#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::live {

/// What a live run did with what was recorded, in order: a replay that does the same makes the same map.
struct JournalEvent {
  enum class Kind {
    add,     ///< an observation was given to the mapper
    drop,    ///< an observation was left out, for a newer one of its camera
    bundle,  ///< the mapper began to work on the oldest bundle whose perception was done
    job      ///< the mapper took the oldest job
  };
  Kind kind = Kind::add;
  std::uint64_t number = 0;  ///< of the observation, among the usable ones of the recording, from 0 on

  bool operator==(const JournalEvent& other) const { return kind == other.kind && number == other.number; }
};

/// Writes a journal, NAME.journal beside the rawlogs NAME.rawlog, NAME_001.rawlog and so on. Not for several threads.
class JournalWriter {
 public:
  /// Throws Error(unwritable_output) if the file cannot be made.
  explicit JournalWriter(const std::string& path);
  void add(const JournalEvent& event);
  /// To the system, so that it outlives this process. False if it cannot be written any more.
  bool flush();

 private:
  std::ofstream file_;
};

/// A journal and the rawlogs that it is about.
struct Journal {
  std::vector<JournalEvent> events;
  std::vector<std::string> rawlogs;  ///< paths, in their order

  /// What can be read of one whose writer was killed: up to the last whole line. Throws Error(unreadable_input) for a
  /// file that is no journal, or whose first rawlog is not beside it, naming file and line.
  static Journal read(const std::string& path);
};

/// The journal that a path names: that file, or the only journal in that folder or in the folder recording in it.
/// Throws Error(unreadable_input) for a folder with none, or with several, naming them.
std::string findJournal(const std::string& path);

/// Where the INI of the live run stands that wrote this journal, TIME.ini beside TIME.journal.
std::string iniOf(const std::string& journal);

/// That INI, if it is there. A recording may come from anybody: throws Error(unreadable_input) for one that does not
/// begin with base::kWrittenFromALog, which would be trusted with plugin libraries.
std::optional<std::string> findIni(const std::string& journal);

}  // namespace omnimapper::live
