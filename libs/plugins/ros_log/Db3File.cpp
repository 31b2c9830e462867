#include "Db3File.h"

#include <omnimapper/source/refuse.h>

#include <algorithm>
#include <filesystem>

#include "decompressed.h"

namespace omnimapper::ros {

namespace {

std::string textAt(sqlite3_stmt* row, int column) {
  const auto* text = static_cast<const char*>(sqlite3_column_blob(row, column));
  const int size = sqlite3_column_bytes(row, column);
  return text && size > 0 ? std::string(text, static_cast<std::size_t>(size)) : "";
}

// SQLite's name of a file that nobody writes, or with its journal.
std::string uriOf(const std::string& path, bool with_journal) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    if (c == '%' || c == '?' || c == '#')
      uri += c == '%' ? "%25" : c == '?' ? "%3f" : "%23";
    else
      uri += c;
  }
  return uri + (with_journal ? "?mode=ro" : "?mode=ro&immutable=1");
}

bool hasJournal(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path + "-wal", error);
  return !error && size > 0;
}

}  // namespace

bool Db3File::recognizes(const std::string& head) {
  return head.rfind(std::string("SQLite format 3\0", 16), 0) == 0;
}

Db3File::Db3File(const std::string& path, Channels& channels) {
  open(path);
  if (!hasTable("topics") || !hasTable("messages"))
    source::refuse(path, damage_.what.empty()
                             ? "is an SQLite file without the tables topics and messages of a ROS 2 bag"
                             : damage_.what + "; copy or record it again");
  readTopics(channels);
  cutIntoChunks();
}

void Db3File::open(const std::string& path) {
  bool with_journal = hasJournal(path);
  for (const bool journal : {with_journal, false}) {
    sqlite3* made = nullptr;
    const int result = sqlite3_open_v2(uriOf(path, journal).c_str(), &made,
                                       SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX, nullptr);
    database_.reset(made);
    if (result != SQLITE_OK) continue;
    if (sqlite3_exec(made, "SELECT count(*) FROM sqlite_master", nullptr, nullptr, nullptr) != SQLITE_OK && journal)
      continue;  // its folder cannot be written to, which a journal needs
    with_journal = with_journal && !journal;
    break;
  }
  if (with_journal) notes_.push_back("the journal beside " + path + " (-wal) cannot be read: messages may be missing");
  sqlite3_limit(database_.get(), SQLITE_LIMIT_LENGTH, static_cast<int>(kLargestChunk));
  sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_exec(database_.get(), "PRAGMA cell_size_check = ON", nullptr, nullptr, nullptr);
  if (sqlite3_exec(database_.get(), "SELECT count(*) FROM sqlite_master", nullptr, nullptr, nullptr) ==
      SQLITE_CORRUPT) {
    // SQLite then reads a file that has fewer pages than its head states; nothing is written, as it is open for
    // reading.
    sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_WRITABLE_SCHEMA, 1, nullptr);
    damage_.note(true, "is shorter than it states");
  } else {
    sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  }
}

Db3File::Statement Db3File::prepared(const std::string& sql) {
  sqlite3_stmt* made = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &made, nullptr) != SQLITE_OK)
    damage_.note(false,
                 std::string("has a table that cannot be read (SQLite: ") + sqlite3_errmsg(database_.get()) + ")");
  return {made, sqlite3_finalize};
}

bool Db3File::step(sqlite3_stmt* statement) {
  if (!statement) return false;
  const int result = sqlite3_step(statement);
  if (result != SQLITE_ROW && result != SQLITE_DONE)
    damage_.note(false, std::string("has rows that cannot be read (SQLite: ") + sqlite3_errmsg(database_.get()) + ")");
  return result == SQLITE_ROW;
}

bool Db3File::hasTable(const std::string& name) {
  // A view could compute its rows without end.
  const auto statement = prepared("SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = '" + name + "'");
  return step(statement.get());
}

std::map<std::string, std::string> Db3File::readDefinitions() {
  std::map<std::string, std::string> definitions;
  if (!hasTable("message_definitions")) return definitions;
  const auto rows = prepared("SELECT topic_type, encoding, encoded_message_definition FROM message_definitions");
  while (step(rows.get()))
    if (textAt(rows.get(), 1) == "ros2msg") definitions[textAt(rows.get(), 0)] = textAt(rows.get(), 2);
  return definitions;
}

void Db3File::readTopics(Channels& channels) {
  const auto definitions = readDefinitions();
  const auto rows = prepared("SELECT id, name, type, serialization_format FROM topics");
  while (step(rows.get())) {
    const std::string type = textAt(rows.get(), 2);
    const auto definition = definitions.find(type);
    topics_[sqlite3_column_int64(rows.get(), 0)] =
        channels.index({textAt(rows.get(), 1), plainType(type),
                        definition == definitions.end() ? "" : definition->second, textAt(rows.get(), 3)});
  }
}

void Db3File::cutIntoChunks() {
  constexpr std::uint64_t kBytes = std::uint64_t{1} << 20;
  const auto rows = prepared("SELECT id, timestamp, length(data) FROM messages ORDER BY id");
  while (step(rows.get())) {
    const std::int64_t row = sqlite3_column_int64(rows.get(), 0);
    if (chunks_.empty() || chunks_.back().size > kBytes) {
      chunks_.emplace_back();
      chunks_.back().offset = static_cast<std::uint64_t>(row);
      last_rows_.emplace_back();
    }
    constexpr std::uint64_t kOfRow = 32;  // [bytes] beside the message
    chunks_.back().size +=
        static_cast<std::uint64_t>(std::max<std::int64_t>(0, sqlite3_column_int64(rows.get(), 2))) + kOfRow;
    chunks_.back().include(boundedTime(sqlite3_column_int64(rows.get(), 1)));
    last_rows_.back() = row;
  }
}

std::vector<Message> Db3File::load(std::size_t chunk) {
  std::vector<Message> messages;
  const auto rows = prepared("SELECT topic_id, timestamp, data FROM messages WHERE id BETWEEN ?1 AND ?2 ORDER BY id");
  if (!rows) return messages;
  sqlite3_bind_int64(rows.get(), 1, static_cast<std::int64_t>(chunks_[chunk].offset));
  sqlite3_bind_int64(rows.get(), 2, last_rows_[chunk]);
  while (step(rows.get())) {
    const auto topic = topics_.find(sqlite3_column_int64(rows.get(), 0));
    if (topic == topics_.end()) {
      damage_.note(false, "has messages of a topic that it does not describe, which are left out");
      continue;
    }
    std::string data = textAt(rows.get(), 2);
    if (isZstd(data)) {
      auto unpacked = decompressed("zstd", data, kLargestChunk);
      if (!unpacked.problem.empty()) {
        damage_.note(false, "has a compressed message that " + unpacked.problem + ", which is left out");
        continue;
      }
      data = std::move(unpacked.bytes);
    }
    auto buffer = std::make_shared<const std::string>(std::move(data));
    messages.push_back({topic->second, boundedTime(sqlite3_column_int64(rows.get(), 1)), buffer, *buffer});
  }
  return messages;
}

}  // namespace omnimapper::ros
