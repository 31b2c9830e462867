#pragma once

#include <map>
#include <optional>

#include "Container.h"
#include "RandomFile.h"

namespace omnimapper::ros {

/// A ROS 1 bag of version 2.0 (http://wiki.ros.org/Bags/Format/2.0): chunks that are not compressed or compressed with
/// bz2 or lz4, or messages without chunks; with or without indices.
class BagFile : public Container {
 public:
  static bool recognizes(const std::string& head);

  /// Throws Error(unreadable_input) for another version, and for an encrypted bag.
  BagFile(const std::string& path, Channels& channels);

  std::vector<Message> load(std::size_t chunk) override;

 private:
  struct Record;
  struct Packing {
    std::string compression;  // "none" for messages without a chunk
    std::uint64_t size = 0;   // [bytes] uncompressed, as the chunk states
  };
  std::optional<Record> recordAt(std::uint64_t offset);
  void walk();
  /// The first chunk after damaged bytes that the bag's index has; 0 if the index does not help.
  std::uint64_t chunkAfter(std::uint64_t damaged);
  void take(const Record& record);
  void addConnection(std::string_view header, std::string_view data);
  void addBareMessage(const Record& record);
  void readIndex(const Record& record);
  void readMessages(const std::shared_ptr<const std::string>& buffer, std::vector<Message>& messages);

  std::string path_;
  RandomFile file_;
  Channels& channels_;
  std::vector<Packing> packings_;                     // of the chunks
  std::map<std::uint64_t, std::size_t> connections_;  // channels by the bag's numbers
  std::uint64_t index_position_ = 0;                  // [bytes] of the index at the end; 0: there is none
  int damages_ = 0;                                   // places at which the walk went on with the index
  bool is_bare_ = false;                              // the last chunk is a run of messages without a chunk
};

}  // namespace omnimapper::ros
