#include "McapFile.h"

#include <zlib.h>

#include <algorithm>

#include "decompressed.h"

namespace omnimapper::ros {

namespace {

constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);
constexpr std::uint64_t kMcapRecordHead = 9;                          // [bytes] of op and length
constexpr std::uint64_t kLargestSchema = std::uint64_t{1} << 24;      // [bytes]
constexpr std::uint64_t kMcapChunkHead = 8 + 8 + 8 + 4 + 4 + 32 + 8;  // [bytes] with a name of up to 32 bytes
enum McapOp : std::uint64_t { kMcapFooter = 2, kMcapSchema = 3, kMcapChannel = 4, kMcapMessage = 5, kMcapChunk = 6 };

std::int64_t signedTime(std::uint64_t nanoseconds) {
  return nanoseconds > static_cast<std::uint64_t>(kLatestTime) ? kLatestTime : static_cast<std::int64_t>(nanoseconds);
}

}  // namespace

bool McapFile::recognizes(const std::string& head) {
  return head.rfind(kMcapMagic, 0) == 0;
}

McapFile::McapFile(const std::string& path, Channels& channels) : file_(path), channels_(channels) {
  walk();
  timeChunks();
}

void McapFile::walk() {
  std::uint64_t offset = kMcapMagic.size();
  try {
    for (bool is_last = false; !is_last;) {
      const std::string head = file_.readSmall(offset, kMcapRecordHead);
      if (head.size() < kMcapRecordHead) {
        damage_.note(true, "ends without its footer, at byte " + std::to_string(offset));
        return;
      }
      const std::uint64_t size = base::fromBytes(head.data() + 1, 8), begin = offset + kMcapRecordHead;
      const auto op = static_cast<unsigned char>(head[0]);
      const bool is_cut = size > file_.size() - begin;
      if (is_cut && op > 0x0f) throw BadBytes("has a record that is damaged");
      if (is_cut) damage_.note(true, "ends in the middle of a record, which begins at byte " + std::to_string(offset));
      is_last = take(op, offset, begin, std::min(size, file_.size() - begin)) || is_cut;
      offset = begin + size;
    }
  } catch (const BadBytes& bad) {
    damage_.note(false,
                 std::string(bad.what()) + ", at byte " + std::to_string(offset) + "; nothing is read from there on");
  }
}

bool McapFile::take(std::uint64_t op, std::uint64_t record, std::uint64_t offset, std::uint64_t size) {
  if (op == kMcapChunk) {
    addChunk(offset, size);
  } else if (op == kMcapMessage) {
    addBareMessage(record, offset, size);
  } else if (op == kMcapSchema || op == kMcapChannel) {
    const std::string content = file_.readSmall(offset, std::min(size, kLargestSchema));
    op == kMcapSchema ? addSchema(ByteCursor(content)) : addChannel(ByteCursor(content));
  }
  is_bare_ = is_bare_ && (op == kMcapMessage || op == kMcapSchema || op == kMcapChannel);
  return op == kMcapFooter;
}

void McapFile::addChunk(std::uint64_t offset, std::uint64_t size) {
  const std::string head = file_.readSmall(offset, std::min(size, kMcapChunkHead));
  ByteCursor cursor(head);
  Chunk chunk;
  chunk.include(signedTime(cursor.uint(8)));
  chunk.include(signedTime(cursor.uint(8)));
  Packing packing;
  packing.size = cursor.uint(8);
  packing.checksum = static_cast<std::uint32_t>(cursor.uint(4));
  packing.compression = std::string(cursor.text());
  cursor.uint(8);
  chunk.offset = offset + cursor.position();
  chunk.size = size - cursor.position();
  if (!isKnownCompression(packing.compression)) throw BadBytes("has a chunk with an unknown compression");
  if (packing.size > kLargestChunk || chunk.size > kLargestChunk) throw BadBytes("has a chunk of more than 256 MiB");
  chunks_.push_back(chunk);
  packings_.push_back(packing);
}

void McapFile::addBareMessage(std::uint64_t record, std::uint64_t offset, std::uint64_t size) {
  constexpr std::uint64_t kRun = std::uint64_t{1} << 20;
  const std::string head = file_.readSmall(offset, std::min<std::uint64_t>(size, 14));
  ByteCursor cursor(head);
  cursor.raw(6);
  const std::int64_t time = signedTime(cursor.uint(8));
  if (size > kLargestChunk) throw BadBytes("has a message of more than 256 MiB");
  if (!is_bare_ || chunks_.back().size > kRun) {
    packings_.push_back({"", kLargestChunk + kRun, 0});
    chunks_.emplace_back();
    chunks_.back().offset = record;
    is_bare_ = true;
  }
  chunks_.back().size = offset + size - chunks_.back().offset;
  chunks_.back().include(time);
}

void McapFile::addSchema(ByteCursor cursor) {
  const std::uint64_t id = cursor.uint(2);
  Schema schema;
  schema.name = plainType(std::string(cursor.text()));
  schema.encoding = std::string(cursor.text());
  schema.text = std::string(cursor.text());
  schemas_[id] = schema;
}

void McapFile::addChannel(ByteCursor cursor) {
  const std::uint64_t id = cursor.uint(2);
  const Schema& schema = schemas_[cursor.uint(2)];
  const std::string topic(cursor.text()), encoding(cursor.text());
  const bool is_text = schema.encoding == "ros2msg" || schema.encoding == "ros1msg";
  ids_[id] = channels_.index({topic, schema.name, is_text ? schema.text : "", encoding});
}

std::vector<Message> McapFile::load(std::size_t chunk) {
  const Packing& packing = packings_[chunk];
  const std::string bytes = file_.read(chunks_[chunk].offset, chunks_[chunk].size);
  auto unpacked = decompressed(packing.compression, bytes, static_cast<std::size_t>(packing.size));
  const std::string place = ", in the chunk at byte " + std::to_string(chunks_[chunk].offset);
  std::vector<Message> messages;
  if (!unpacked.problem.empty()) {
    damage_.note(false, "has a chunk whose data " + unpacked.problem + place);
  } else if (packing.checksum != 0 && unpacked.bytes.size() == packing.size &&
             ::crc32_z(0, reinterpret_cast<const Bytef*>(unpacked.bytes.data()), unpacked.bytes.size()) !=
                 packing.checksum) {
    damage_.note(false, "has a chunk with a wrong checksum, which is left out" + place);
    return messages;
  }
  try {
    readRecords(std::make_shared<const std::string>(std::move(unpacked.bytes)), messages);
  } catch (const BadBytes& bad) {
    damage_.note(false, std::string("has a record that ") + bad.what() + place);
  }
  return messages;
}

void McapFile::readRecords(const std::shared_ptr<const std::string>& buffer, std::vector<Message>& messages) {
  for (ByteCursor cursor(*buffer); cursor.left() > 0;) {
    const std::uint64_t op = cursor.uint(1);
    ByteCursor record(cursor.raw(cursor.uint(8)));
    if (op == kMcapSchema) addSchema(record);
    if (op == kMcapChannel) addChannel(record);
    if (op != kMcapMessage) continue;
    const auto channel = ids_.find(record.uint(2));
    if (channel == ids_.end()) throw BadBytes("belongs to a channel that the file does not describe");
    record.uint(4);
    const std::int64_t time = signedTime(record.uint(8));
    record.uint(8);
    messages.push_back({channel->second, time, buffer, record.raw(record.left())});
  }
}

}  // namespace omnimapper::ros
