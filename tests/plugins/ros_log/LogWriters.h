#pragma once

#include <bzlib.h>
#include <lz4frame.h>
#include <sqlite3.h>
#include <zlib.h>
#include <zstd.h>

#include <fstream>
#include <map>

#include "Serializer.h"

// Writers of the three kinds of logs, with what real ones lack or have wrong as options.
namespace omnimapper::ros_test {

struct Topic {
  std::string name, type, definition;
};
struct Written {
  std::size_t topic = 0;
  std::int64_t time = 0;  // [ns]
  std::string bytes;
};

inline std::string packed(const std::string& compression, const std::string& bytes) {
  std::string out(bytes.size() + 65536, '\0');
  if (compression == "bz2") {
    auto size = static_cast<unsigned>(out.size());
    BZ2_bzBuffToBuffCompress(out.data(), &size, const_cast<char*>(bytes.data()), static_cast<unsigned>(bytes.size()), 9,
                             0, 0);
    out.resize(size);
  } else if (compression == "lz4") {
    out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr));
  } else if (compression == "zstd") {
    out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3));
  } else {
    return bytes;
  }
  return out;
}

inline std::string number(std::uint64_t value, int size) {
  return Serializer(false).uint(value, size).bytes();
}
inline std::string block(const std::string& bytes) {
  return number(bytes.size(), 4) + bytes;
}

/// A bag of ROS 1.
struct BagWriter {
  std::string compression = "none";
  std::size_t messages_in_chunk = 2;
  bool is_indexed = true, has_chunks = true;
  std::vector<std::size_t> order;  // of the chunks in the file; empty: as they come

  std::string text(const std::vector<Topic>& topics, const std::vector<Written>& messages) const {
    std::vector<std::string> parts;
    std::string connections;
    for (std::size_t i = 0; i < topics.size(); ++i) connections += connection(i, topics[i]);
    for (std::size_t at = 0; at < messages.size(); at += messages_in_chunk)
      parts.push_back(part(topics, messages, at, std::min(messages.size(), at + messages_in_chunk)));
    std::string body = has_chunks ? "" : connections;
    for (std::size_t i = 0; i < parts.size(); ++i) body += parts[order.empty() ? i : order[i]];
    const std::uint64_t index = is_indexed ? 13 + 4096 + body.size() : 0;
    std::string head = record({{"op", "\x03"},
                               {"index_pos", number(index, 8)},
                               {"conn_count", number(topics.size(), 4)},
                               {"chunk_count", number(parts.size(), 4)}},
                              "");
    const std::size_t padding = 4096 - head.size();
    head.resize(head.size() - 4);
    return "#ROSBAG V2.0\n" + head + block(std::string(padding, ' ')) + body + (is_indexed ? connections : "");
  }
  void write(const std::string& path, const std::vector<Topic>& topics, const std::vector<Written>& messages) const {
    std::ofstream(path, std::ios::binary) << text(topics, messages);
  }

 private:
  using Fields = std::vector<std::pair<std::string, std::string>>;
  static std::string fieldsOf(const Fields& fields) {
    std::string text;
    for (const auto& [name, value] : fields) text += block(name + "=" + value);
    return text;
  }
  static std::string record(const Fields& fields, const std::string& data) {
    return block(fieldsOf(fields)) + block(data);
  }
  static std::string timeOf(std::int64_t time) {
    return number(static_cast<std::uint64_t>(time / 1'000'000'000), 4) +
           number(static_cast<std::uint64_t>(time % 1'000'000'000), 4);
  }
  static std::string connection(std::size_t id, const Topic& topic) {
    return record(
        {{"op", "\x07"}, {"conn", number(id, 4)}, {"topic", topic.name}},
        fieldsOf(
            {{"topic", topic.name}, {"type", topic.type}, {"md5sum", "*"}, {"message_definition", topic.definition}}));
  }
  std::string part(const std::vector<Topic>& topics, const std::vector<Written>& messages, std::size_t from,
                   std::size_t to) const {
    std::string content, entries;
    for (std::size_t i = 0; has_chunks && i < topics.size(); ++i) content += connection(i, topics[i]);
    for (std::size_t i = from; i < to; ++i) {
      entries += timeOf(messages[i].time) + number(content.size(), 4);
      content += record({{"op", "\x02"}, {"conn", number(messages[i].topic, 4)}, {"time", timeOf(messages[i].time)}},
                        messages[i].bytes);
    }
    if (!has_chunks) return content;
    std::string chunk = record({{"op", "\x05"}, {"compression", compression}, {"size", number(content.size(), 4)}},
                               packed(compression, content));
    if (is_indexed)
      chunk += record({{"op", "\x04"}, {"ver", number(1, 4)}, {"conn", number(0, 4)}, {"count", number(to - from, 4)}},
                      entries);
    return chunk;
  }
};

/// An MCAP file of ROS 2.
struct McapWriter {
  std::string compression;  // "", "lz4" or "zstd"
  std::size_t messages_in_chunk = 2;
  bool has_chunks = true, has_end = true, has_wrong_checksum = false;
  std::string schema_encoding = "ros2msg", message_encoding = "cdr";

  std::string text(const std::vector<Topic>& topics, const std::vector<Written>& messages) const {
    const std::string magic("\x89MCAP0\r\n", 8);
    std::string content = magic + record(1, block("ros2") + block("test"));
    if (!has_chunks) content += channels(topics);
    for (std::size_t at = 0; at < messages.size(); at += messages_in_chunk) {
      std::string records = has_chunks ? channels(topics) : "";
      const std::size_t to = std::min(messages.size(), at + messages_in_chunk);
      std::int64_t first = messages[at].time, last = first;
      for (std::size_t i = at; i < to; ++i) {
        first = std::min(first, messages[i].time);
        last = std::max(last, messages[i].time);
        records += record(5, number(messages[i].topic + 1, 2) + number(i, 4) + time(messages[i].time) +
                                 time(messages[i].time) + messages[i].bytes);
      }
      content += has_chunks ? chunk(records, first, last) : records;
    }
    if (has_end) content += record(15, number(0, 4)) + record(2, number(0, 8) + number(0, 8) + number(0, 4)) + magic;
    return content;
  }
  void write(const std::string& path, const std::vector<Topic>& topics, const std::vector<Written>& messages) const {
    std::ofstream(path, std::ios::binary) << text(topics, messages);
  }

 private:
  static std::string time(std::int64_t time) { return number(static_cast<std::uint64_t>(time), 8); }
  static std::string record(int op, const std::string& content) {
    return static_cast<char>(op) + number(content.size(), 8) + content;
  }
  std::string channels(const std::vector<Topic>& topics) const {
    std::string records;
    for (std::size_t i = 0; i < topics.size(); ++i) {
      records +=
          record(3, number(i + 1, 2) + block(topics[i].type) + block(schema_encoding) + block(topics[i].definition));
      records += record(
          4, number(i + 1, 2) + number(i + 1, 2) + block(topics[i].name) + block(message_encoding) + number(0, 4));
    }
    return records;
  }
  std::string chunk(const std::string& records, std::int64_t first, std::int64_t last) const {
    const auto checksum = ::crc32(0, reinterpret_cast<const Bytef*>(records.data()), static_cast<uInt>(records.size()));
    const std::string data = packed(compression, records);
    return record(6, time(first) + time(last) + number(records.size(), 8) +
                         number(checksum + (has_wrong_checksum ? 1 : 0), 4) + block(compression) +
                         number(data.size(), 8) + data);
  }
};

/// An SQLite file of ROS 2.
struct Db3Writer {
  bool has_definitions = true, packs_messages = false;

  void write(const std::string& path, const std::vector<Topic>& topics, const std::vector<Written>& messages) const {
    sqlite3* database = nullptr;
    sqlite3_open(path.c_str(), &database);
    run(database, "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)");
    run(database, "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)");
    if (has_definitions)
      run(database,
          "CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT, encoding TEXT, "
          "encoded_message_definition TEXT)");
    for (std::size_t i = 0; i < topics.size(); ++i) {
      run(database, "INSERT INTO topics VALUES(" + std::to_string(i + 1) + ", '" + topics[i].name + "', '" +
                        topics[i].type + "', 'cdr')");
      if (has_definitions)
        run(database, "INSERT INTO message_definitions VALUES(NULL, '" + topics[i].type + "', 'ros2msg', '" +
                          topics[i].definition + "')");
    }
    sqlite3_stmt* insert = nullptr;
    sqlite3_prepare_v2(database, "INSERT INTO messages VALUES(NULL, ?, ?, ?)", -1, &insert, nullptr);
    for (const auto& message : messages) {
      const std::string data = packs_messages ? packed("zstd", message.bytes) : message.bytes;
      sqlite3_bind_int64(insert, 1, static_cast<std::int64_t>(message.topic + 1));
      sqlite3_bind_int64(insert, 2, message.time);
      sqlite3_bind_blob(insert, 3, data.data(), static_cast<int>(data.size()), SQLITE_TRANSIENT);
      sqlite3_step(insert);
      sqlite3_reset(insert);
    }
    sqlite3_finalize(insert);
    sqlite3_close(database);
  }

 private:
  static void run(sqlite3* database, const std::string& sql) {
    sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr);
  }
};

}  // namespace omnimapper::ros_test
