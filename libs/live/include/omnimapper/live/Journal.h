#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::live {

/// One action of a live run on an observation of its recording, or on a bundle or job. A replay that does the same
/// actions in the same order makes the same map.
struct JournalEvent {
  enum class Kind {
    add,      ///< an observation was given to the mapper
    drop,     ///< an observation was left out: a newer one of its camera came, or [source] labels excludes it
    plugins,  ///< plugins were added or removed: INI number `number` of the run holds from here on
    bundle,   ///< the mapper began to work on the oldest bundle whose perception was done
    job       ///< the mapper took the oldest job
  };
  Kind kind = Kind::add;
  /// For add and drop: index of the observation among the usable ones of the recording. For plugins: from 1.
  std::uint64_t number = 0;

  bool operator==(const JournalEvent& other) const { return kind == other.kind && number == other.number; }
};

/// Writes a journal. The journal of the rawlogs NAME.rawlog, NAME_001.rawlog and so on is NAME.journal in the same
/// folder. Not thread-safe.
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
  std::vector<std::string> rawlogs;  ///< paths, in the order of recording

  /// Reads a journal up to its last complete line, because its writer may have been killed. Throws
  /// Error(unreadable_input), naming the file, if it is not a journal, has a damaged line (which is named), or if its
  /// first rawlog is not in the same folder.
  static Journal read(const std::string& path);
};

/// The path of a journal. If `path` is a file, it is returned; if it is a folder, the only journal in this folder and
/// its subfolder `recording`. Throws Error(unreadable_input) if there is no journal there, or several, of which the
/// message names the first.
std::string findJournal(const std::string& path);

/// The path of the INI of the live run that wrote this journal: TIME.ini in the folder of TIME.journal. If plugins were
/// changed during the run, the INI after change number n is TIME.n.ini.
std::string iniOf(const std::string& journal, std::uint64_t change = 0);

/// The path of the INI of the live run, if the file exists. Throws Error(unreadable_input) if the INI does not begin
/// with base::kWrittenFromALog: without this beginning, the plugin libraries that the INI names would be loaded, and a
/// recording may come from anybody.
std::optional<std::string> findIni(const std::string& journal, std::uint64_t change = 0);

}  // namespace omnimapper::live
