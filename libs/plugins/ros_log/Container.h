#pragma once

#include <memory>
#include <string>
#include <vector>

#include "Channel.h"

namespace omnimapper::ros {

/// What is wrong with a file.
struct Damage {
  bool is_cut = false;  ///< the file only ends too early
  std::string what;     ///< a clause whose subject is the file: "ends in the middle of a chunk"; empty: nothing
  /// Keeps the first damage.
  void note(bool cut, const std::string& text) {
    if (what.empty()) *this = {cut, text};
  }
};

/// A file of a log: chunks of messages. Nothing is taken from indices, which may be missing or wrong: opening a file
/// walks over its records once, without reading the messages of chunks that are indexed.
class Container {
 public:
  virtual ~Container() = default;
  /// In the order of the file.
  const std::vector<Chunk>& chunks() const { return chunks_; }
  /// The messages of a chunk in the order of the file; of a damaged chunk, those that can be read.
  virtual std::vector<Message> load(std::size_t chunk) = 0;
  const Damage& damage() const { return damage_; }
  /// Damage of the compressed file of which this one was unpacked, which explains all other damage.
  void setDamageOfUnpacking(const Damage& damage) { damage_ = damage; }
  /// Sentences about the file, for the user.
  const std::vector<std::string>& notes() const { return notes_; }

 protected:
  /// A chunk whose index is missing is read for its times.
  void timeChunks();

  std::vector<Chunk> chunks_;
  Damage damage_;
  std::vector<std::string> notes_;
};

/// Largest size of a chunk or a message that is read [bytes]; a file can state any size.
inline constexpr std::uint64_t kLargestChunk = std::uint64_t{1} << 28;

/// Opens a file by its first bytes. Throws Error(unreadable_input) if it is no log of ROS.
std::unique_ptr<Container> openContainer(const std::string& path, Channels& channels);

}  // namespace omnimapper::ros
