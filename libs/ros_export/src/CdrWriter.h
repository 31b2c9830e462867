#pragma once

#include <omnimapper/base/Bytes.h>

#include <cstring>
#include <string>
#include <string_view>

namespace omnimapper::ros_export {

/// Serializes the fields of a message one after another as CDR, little-endian: each number is aligned to its size, and
/// a text ends with a zero.
class CdrWriter {
 public:
  CdrWriter() : bytes_("\0\1\0\0", kHead) {}

  CdrWriter& uint(std::uint64_t value, std::size_t size) {
    while ((bytes_.size() - kHead) % size != 0) bytes_ += '\0';
    char buffer[8];
    base::toBytes(value, static_cast<int>(size), buffer);
    bytes_.append(buffer, size);
    return *this;
  }
  CdrWriter& byte(std::uint8_t value) { return uint(value, 1); }
  /// An int32, or the length of a sequence.
  CdrWriter& integer(std::int64_t value) { return uint(static_cast<std::uint64_t>(value), 4); }
  CdrWriter& real(double value) { return uint(base::bitsOf(value), 8); }
  CdrWriter& real32(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return uint(bits, 4);
  }
  CdrWriter& text(std::string_view text) {
    uint(text.size() + 1, 4);
    bytes_.append(text);
    bytes_ += '\0';
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  static constexpr std::size_t kHead = 4;  // which says that CDR follows, and its order of bytes
  std::string bytes_;
};

}  // namespace omnimapper::ros_export
