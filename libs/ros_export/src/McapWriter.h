#pragma once

#include <omnimapper/base/Bytes.h>

#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::ros_export {

/// Writes an MCAP file (https://mcap.dev/spec) of the profile ros2: chunks without compression, with checksums and
/// indices.
class McapWriter {
 public:
  explicit McapWriter(std::ostream& out);

  /// Adds a topic, whose type is defined by the text `definition` in the form ros2msg, and returns its number. All
  /// topics are added before the first message.
  std::uint16_t addTopic(const std::string& name, const std::string& type, const std::string& definition);
  /// Adds a message that is serialized as CDR; `time` is in nanoseconds since 1970.
  void add(std::uint16_t topic, std::uint64_t time, const std::string& cdr);
  /// Writes the indices and the end of the file.
  void finish();

 private:
  struct Chunk {
    std::string records;
    std::uint64_t first_time = 0, last_time = 0;
    std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>>
        entries;  // times and offsets by topic
  };
  void put(const std::string& bytes);
  void putChunk();
  std::string statistics() const;

  std::ostream& out_;
  std::uint64_t position_ = 0;       // [bytes] in the file
  std::vector<std::string> topics_;  // the records of each topic: its schema and its channel
  std::vector<std::string> chunk_indices_;
  Chunk chunk_;
  std::map<std::uint16_t, std::uint64_t> counts_;  // messages by topic
  std::uint64_t first_time_ = 0, last_time_ = 0;
};

}  // namespace omnimapper::ros_export
