#include "BagFile.h"

#include <omnimapper/source/refuse.h>

#include <algorithm>

#include "ByteCursor.h"
#include "decompressed.h"

namespace omnimapper::ros {

namespace {

constexpr std::string_view kBagMagic = "#ROSBAG V2.0\n";
constexpr std::uint64_t kLargestBagHeader = std::uint64_t{1} << 24;  // definitions of messages are in data, not in it
enum BagOp : std::uint64_t {
  kMessageOp = 2,
  kBagHeaderOp = 3,
  kIndexOp = 4,
  kChunkOp = 5,
  kChunkInfoOp = 6,
  kConnectionOp = 7
};
constexpr std::uint64_t kIndexEntry = 12;  // [bytes]: time and offset

// The fields of a header, which has three or four short ones: they are searched rather than sorted.
class BagFields {
 public:
  explicit BagFields(std::string_view header) : header_(header) {}
  /// Empty if there is no such field.
  std::string_view text(std::string_view name) const {
    for (ByteCursor cursor(header_); cursor.left() > 0;) {
      const std::string_view field = cursor.text();
      const auto equals = field.find('=');
      if (equals == std::string_view::npos) throw BadBytes("has a field without a name");
      if (field.substr(0, equals) == name) return field.substr(equals + 1);
    }
    return {};
  }
  std::uint64_t number(std::string_view name, int size) const { return ByteCursor(text(name)).uint(size); }
  std::int64_t time(std::string_view name) const {
    ByteCursor cursor(text(name));
    const std::uint64_t seconds = cursor.uint(4);
    return boundedTime(static_cast<std::int64_t>(seconds * 1'000'000'000 + cursor.uint(4)));
  }

 private:
  std::string_view header_;
};

}  // namespace

struct BagFile::Record {
  std::uint64_t offset = 0;  // [bytes] of the record in the file
  std::string header;
  std::uint64_t data_offset = 0, data_size = 0;
  std::uint64_t op = 0;
  std::uint64_t end() const { return data_offset + data_size; }
};

bool BagFile::recognizes(const std::string& head) {
  return head.rfind("#ROSBAG", 0) == 0 || head.rfind("#ROSRECORD", 0) == 0;
}

BagFile::BagFile(const std::string& path, Channels& channels) : path_(path), file_(path), channels_(channels) {
  const std::string head = file_.read(0, kLogHead);
  if (head.rfind(kBagMagic, 0) != 0)
    source::refuse(path, "is a bag of another version (" + head.substr(1, std::min(head.find('\n'), kLogHead) - 1) +
                             "), and only V2.0 is read; where ROS 1 is, `rosbag fix` makes one of it");
  walk();
  timeChunks();
}

std::optional<BagFile::Record> BagFile::recordAt(std::uint64_t offset) {
  Record record;
  record.offset = offset;
  const std::string length = file_.readSmall(offset, 4);
  if (length.size() < 4) return std::nullopt;
  const std::uint64_t header_size = base::fromBytes(length.data(), 4);
  if (header_size > kLargestBagHeader) throw BadBytes("has a record whose header is damaged");
  record.header = file_.readSmall(offset + 4, header_size);
  const std::string data_length = file_.readSmall(offset + 4 + header_size, 4);
  if (record.header.size() < header_size || data_length.size() < 4) return std::nullopt;
  record.data_size = base::fromBytes(data_length.data(), 4);
  record.data_offset = offset + 8 + header_size;
  const BagFields fields(record.header);
  record.op = fields.number("op", 1);
  // Bags of 2010 state too large a size for their indices.
  if (record.op == kIndexOp && fields.number("ver", 4) == 1)
    record.data_size = std::min(record.data_size, kIndexEntry * fields.number("count", 4));
  return record;
}

void BagFile::walk() {
  std::uint64_t offset = kBagMagic.size();
  while (offset < file_.size()) {
    try {
      const auto record = recordAt(offset);
      if (!record) throw BadBytes("has a record that goes on beyond the end of the file");
      const bool is_cut = record->end() > file_.size();
      if (!is_cut || record->op == kChunkOp) take(*record);  // a chunk is read as far as it goes
      if (is_cut) throw BadBytes("has a record that goes on beyond the end of the file");
      offset = record->end();
    } catch (const BadBytes& bad) {
      const std::uint64_t next = chunkAfter(offset);
      damage_.note(next == 0, std::string(bad.what()) + ", at byte " + std::to_string(offset) +
                                  (next > 0 ? "; what follows is read from byte " + std::to_string(next) + " on"
                                            : "; nothing is read from there on"));
      if (next == 0) return;
      offset = next;
    }
  }
}

std::uint64_t BagFile::chunkAfter(std::uint64_t damaged) {
  constexpr int kMostDamages = 100;  // each reads the index again
  std::uint64_t next = 0;
  if (++damages_ > kMostDamages) return next;
  try {
    for (auto record = recordAt(std::max(index_position_, damaged + 1)); record && record->end() <= file_.size();
         record = recordAt(record->end())) {
      if (record->op == kConnectionOp) take(*record);
      if (record->op != kChunkInfoOp) continue;
      const std::uint64_t chunk = BagFields(record->header).number("chunk_pos", 8);
      if (chunk > damaged && chunk < file_.size() && (next == 0 || chunk < next)) next = chunk;
    }
  } catch (const BadBytes&) {  // the index is damaged, too
  }
  return next;
}

void BagFile::take(const Record& record) {
  if (record.op != kMessageOp && record.op != kConnectionOp) is_bare_ = false;
  const BagFields fields(record.header);
  if (record.op == kBagHeaderOp) {
    if (!fields.text("encryptor").empty()) source::refuse(path_, "is encrypted; decrypt it where ROS 1 is");
    index_position_ = fields.number("index_pos", 8);
    if (index_position_ == 0) notes_.push_back("the bag was not closed, and is read without its index");
  } else if (record.op == kChunkOp) {
    const std::string compression(fields.text("compression"));
    if (!isKnownCompression(compression)) throw BadBytes("has a chunk with an unknown compression");
    const std::uint64_t size = fields.number("size", 4);
    if (size > kLargestChunk || record.data_size > kLargestChunk) throw BadBytes("has a chunk of more than 256 MiB");
    packings_.push_back({compression, size});
    chunks_.emplace_back();
    chunks_.back().offset = record.data_offset;
    chunks_.back().size = record.data_size;
  } else if (record.op == kIndexOp) {
    readIndex(record);
  } else if (record.op == kConnectionOp) {
    addConnection(record.header, file_.readSmall(record.data_offset, std::min(record.data_size, kLargestBagHeader)));
  } else if (record.op == kMessageOp) {
    addBareMessage(record);
  }
}

void BagFile::readIndex(const Record& record) {
  if (chunks_.empty()) return;
  const std::string entries = file_.readSmall(record.data_offset, std::min(record.data_size, kLargestChunk));
  ByteCursor cursor(entries);
  while (cursor.left() >= kIndexEntry) {
    const std::uint64_t seconds = cursor.uint(4), nanoseconds = cursor.uint(4);
    cursor.uint(4);
    chunks_.back().include(boundedTime(static_cast<std::int64_t>(seconds * 1'000'000'000 + nanoseconds)));
  }
}

void BagFile::addBareMessage(const Record& record) {
  constexpr std::uint64_t kRun = std::uint64_t{1} << 20;
  const std::int64_t time = BagFields(record.header).time("time");
  const bool is_first = !is_bare_ || chunks_.back().size > kRun;
  const std::uint64_t begin = is_first ? record.offset : chunks_.back().offset, size = record.end() - begin;
  if (size > kLargestChunk) throw BadBytes("has a message of more than 256 MiB");
  if (is_first) {
    packings_.push_back({"none", kLargestChunk});
    chunks_.emplace_back();
    chunks_.back().offset = begin;
    is_bare_ = true;
  }
  chunks_.back().size = size;
  chunks_.back().include(time);
}

void BagFile::addConnection(std::string_view header, std::string_view data) {
  const BagFields outer(header), inner(data);
  const std::string topic(inner.text("topic").empty() ? outer.text("topic") : inner.text("topic"));
  connections_[outer.number("conn", 4)] = channels_.index(
      {topic, plainType(std::string(inner.text("type"))), std::string(inner.text("message_definition")), "ros1"});
}

std::vector<Message> BagFile::load(std::size_t chunk) {
  const Packing& packing = packings_[chunk];
  const std::string bytes = file_.read(chunks_[chunk].offset, chunks_[chunk].size);
  auto unpacked = decompressed(packing.compression, bytes, static_cast<std::size_t>(packing.size));
  const std::string place = ", in the chunk at byte " + std::to_string(chunks_[chunk].offset);
  if (!unpacked.problem.empty()) damage_.note(false, "has a chunk whose data " + unpacked.problem + place);
  std::vector<Message> messages;
  try {
    readMessages(std::make_shared<const std::string>(std::move(unpacked.bytes)), messages);
  } catch (const BadBytes& bad) {
    damage_.note(false, std::string("has a record that ") + bad.what() + place);
  }
  return messages;
}

void BagFile::readMessages(const std::shared_ptr<const std::string>& buffer, std::vector<Message>& messages) {
  for (ByteCursor cursor(*buffer); cursor.left() > 0;) {
    const std::string_view header = cursor.text(), data = cursor.text();
    const BagFields fields(header);
    const std::uint64_t op = fields.number("op", 1);
    if (op == kConnectionOp) addConnection(header, data);
    if (op != kMessageOp) continue;
    const auto connection = connections_.find(fields.number("conn", 4));
    if (connection == connections_.end()) throw BadBytes("belongs to a connection that the bag does not describe");
    messages.push_back({connection->second, fields.time("time"), buffer, data});
  }
}

}  // namespace omnimapper::ros
