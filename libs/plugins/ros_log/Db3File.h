#pragma once

#include <sqlite3.h>

#include <map>
#include <memory>

#include "Container.h"

namespace omnimapper::ros {

/// An SQLite file of rosbag2: the tables topics and messages, and if it is there message_definitions. A message may be
/// compressed with Zstandard.
class Db3File : public Container {
 public:
  static bool recognizes(const std::string& head);

  /// Throws Error(unreadable_input) if the tables are missing.
  Db3File(const std::string& path, Channels& channels);

  std::vector<Message> load(std::size_t chunk) override;

 private:
  using Database = std::unique_ptr<sqlite3, int (*)(sqlite3*)>;
  using Statement = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;
  void open(const std::string& path);
  /// Null, with the damage noted, if the statement cannot be prepared.
  Statement prepared(const std::string& sql);
  /// Whether there is another row. A row that cannot be read ends the table, with the damage noted.
  bool step(sqlite3_stmt* statement);
  bool hasTable(const std::string& name);
  std::map<std::string, std::string> readDefinitions();
  void readTopics(Channels& channels);
  void cutIntoChunks();

  Database database_{nullptr, sqlite3_close};
  std::map<std::int64_t, std::size_t> topics_;  // channels by the table's numbers
  std::vector<std::int64_t> last_rows_;         // of the chunks
};

}  // namespace omnimapper::ros
