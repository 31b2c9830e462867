#pragma once

#include <map>

#include "ByteCursor.h"
#include "Container.h"
#include "RandomFile.h"

namespace omnimapper::ros {

/// An MCAP file (https://mcap.dev/spec): chunks that are not compressed or compressed with lz4 or zstd, or messages
/// without chunks; with or without a summary.
class McapFile : public Container {
 public:
  static bool recognizes(const std::string& head);

  McapFile(const std::string& path, Channels& channels);

  /// A chunk whose checksum is wrong has no messages.
  std::vector<Message> load(std::size_t chunk) override;

 private:
  struct Packing {
    std::string compression;
    std::uint64_t size = 0;      // [bytes] uncompressed
    std::uint32_t checksum = 0;  // 0: none
  };
  struct Schema {
    std::string name, encoding, text;
  };
  void walk();
  /// Returns whether this was the last record.
  bool take(std::uint64_t op, std::uint64_t record, std::uint64_t offset, std::uint64_t size);
  void addChunk(std::uint64_t offset, std::uint64_t size);
  void addBareMessage(std::uint64_t record, std::uint64_t offset, std::uint64_t size);
  void addSchema(ByteCursor cursor);
  void addChannel(ByteCursor cursor);
  void readRecords(const std::shared_ptr<const std::string>& buffer, std::vector<Message>& messages);

  RandomFile file_;
  Channels& channels_;
  std::vector<Packing> packings_;
  std::map<std::uint64_t, Schema> schemas_;
  std::map<std::uint64_t, std::size_t> ids_;  // channels by the file's numbers
  bool is_bare_ = false;                      // the last chunk is a run of messages without a chunk
};

}  // namespace omnimapper::ros
