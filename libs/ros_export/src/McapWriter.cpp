#include "McapWriter.h"

#include <zlib.h>

#include <algorithm>

namespace omnimapper::ros_export {

namespace {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
enum class Op : std::uint8_t {
  header = 1,
  footer = 2,
  schema = 3,
  channel = 4,
  message = 5,
  chunk = 6,
  message_index = 7,
  chunk_index = 8,
  statistics = 11,
  data_end = 15
};

/// The content of a record: numbers, and texts after their length in four bytes.
class Content : public base::ByteWriter {
 public:
  Content& number(std::uint64_t value, int size) {
    uint(value, size);
    return *this;
  }
  Content& text(std::string_view text) {
    uint(text.size(), 4);
    raw(text);
    return *this;
  }
};

std::string record(Op op, const std::string& content) {
  base::ByteWriter out;
  out.uint(static_cast<std::uint64_t>(op), 1);
  out.block(content);
  return out.take();
}

}  // namespace

McapWriter::McapWriter(std::ostream& out) : out_(out) {
  put(std::string(kMagic) + record(Op::header, Content().text("ros2").text("omnimapper").bytes()));
}

std::uint16_t McapWriter::addTopic(const std::string& name, const std::string& type, const std::string& definition) {
  const auto number = static_cast<std::uint16_t>(topics_.size() + 1);
  topics_.push_back(
      record(Op::schema, Content().number(number, 2).text(type).text("ros2msg").text(definition).bytes()) +
      record(Op::channel, Content().number(number, 2).number(number, 2).text(name).text("cdr").text("").bytes()));
  put(topics_.back());
  return number;
}

void McapWriter::add(std::uint16_t topic, std::uint64_t time, const std::string& cdr) {
  constexpr std::size_t kChunkSize = std::size_t{1} << 20;  // [bytes]
  const bool is_first = counts_.empty();
  first_time_ = is_first ? time : std::min(first_time_, time);
  last_time_ = is_first ? time : std::max(last_time_, time);
  if (chunk_.records.empty()) chunk_.first_time = chunk_.last_time = time;
  chunk_.first_time = std::min(chunk_.first_time, time);
  chunk_.last_time = std::max(chunk_.last_time, time);
  chunk_.entries[topic].emplace_back(time, chunk_.records.size());
  Content message;
  message.number(topic, 2).number(counts_[topic]++, 4).number(time, 8).number(time, 8).raw(cdr);
  chunk_.records += record(Op::message, message.bytes());
  if (chunk_.records.size() >= kChunkSize) putChunk();
}

void McapWriter::put(const std::string& bytes) {
  out_ << bytes;
  position_ += bytes.size();
}

void McapWriter::putChunk() {
  if (chunk_.records.empty()) return;
  const std::string& records = chunk_.records;
  const auto checksum = ::crc32(0, reinterpret_cast<const Bytef*>(records.data()), static_cast<uInt>(records.size()));
  Content content;
  content.number(chunk_.first_time, 8).number(chunk_.last_time, 8).number(records.size(), 8).number(checksum, 4);
  content.text("").block(records);
  const std::string chunk = record(Op::chunk, content.bytes());
  const std::uint64_t start = position_;
  put(chunk);
  Content offsets;
  const std::uint64_t indices = position_;
  for (const auto& [topic, entries] : chunk_.entries) {
    Content places;
    for (const auto& [time, offset] : entries) places.number(time, 8).number(offset, 8);
    offsets.number(topic, 2).number(position_, 8);
    put(record(Op::message_index, Content().number(topic, 2).text(places.bytes()).bytes()));
  }
  Content index;
  index.number(chunk_.first_time, 8).number(chunk_.last_time, 8).number(start, 8).number(chunk.size(), 8);
  index.text(offsets.bytes()).number(position_ - indices, 8).text("").number(records.size(), 8);
  chunk_indices_.push_back(record(Op::chunk_index, index.number(records.size(), 8).bytes()));
  chunk_ = {};
}

std::string McapWriter::statistics() const {
  Content counts;
  std::uint64_t all = 0;
  for (const auto& [topic, count] : counts_) {
    counts.number(topic, 2).number(count, 8);
    all += count;
  }
  constexpr std::uint64_t kAttachments = 0, kMetadata = 0;
  Content content;
  content.number(all, 8).number(topics_.size(), 2).number(topics_.size(), 4).number(kAttachments, 4);
  content.number(kMetadata, 4).number(chunk_indices_.size(), 4).number(first_time_, 8).number(last_time_, 8);
  return record(Op::statistics, content.text(counts.bytes()).bytes());
}

void McapWriter::finish() {
  constexpr std::uint64_t kNone = 0;  // no checksum, no offsets of the summary
  putChunk();
  put(record(Op::data_end, Content().number(kNone, 4).bytes()));
  const std::uint64_t summary = position_;
  for (const auto& topic : topics_) put(topic);
  put(statistics());
  for (const auto& index : chunk_indices_) put(index);
  put(record(Op::footer, Content().number(summary, 8).number(kNone, 8).number(kNone, 4).bytes()));
  put(std::string(kMagic));
}

}  // namespace omnimapper::ros_export
