#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Container.h"

namespace omnimapper::ros {

/// The messages of all files of a log in the order in which they were recorded, whatever their order in the files. Of
/// equal times, the order of the files stays. Chunks are read when their first message is due, so that memory stays
/// bounded: if more than 64 MiB of chunks overlap in time, the earliest message that is at hand comes first.
class MessageReader {
 public:
  /// Throws what openContainer() throws for the first file if no file can be opened; files that cannot be opened beside
  /// others are damage.
  MessageReader(const std::vector<std::string>& files, Channels& channels);

  std::optional<Message> next();
  /// Starts again at the first message.
  void rewind();
  /// Part of the chunks that have been read, in [0, 1].
  double progress() const;
  /// The first damage that was met so far, with the file's path; empty if there is none.
  Damage damage() const;
  std::vector<std::string> notes() const;
  /// Messages that came after a later one, as the bound of the memory requires.
  std::uint64_t unordered() const { return unordered_; }
  /// [bytes] of the messages that were handed out.
  std::uint64_t bytes() const { return bytes_; }

 private:
  struct Place {
    std::size_t file, chunk;
    std::int64_t first_time;
    std::uint64_t size;
  };
  struct Pending {
    Message message;
    std::size_t place, number;  // in places_, and in the chunk
    bool operator<(const Pending& other) const;
  };
  void loadNext();

  std::vector<std::string> files_;
  std::vector<std::unique_ptr<Container>> containers_;
  Damage unopened_;
  std::vector<Place> places_;  // in the order of their first messages
  std::size_t next_place_ = 0;
  std::vector<Pending> pending_;                   // a heap whose front is the earliest
  std::vector<std::size_t> left_;                  // messages of each chunk that are pending
  std::vector<std::uint64_t> sizes_;               // [bytes] of all messages of each chunk that was read
  std::uint64_t held_ = 0, total_ = 0, done_ = 0;  // [bytes]
  std::uint64_t bytes_ = 0, unordered_ = 0;
  std::int64_t latest_ = std::numeric_limits<std::int64_t>::min();
};

}  // namespace omnimapper::ros
