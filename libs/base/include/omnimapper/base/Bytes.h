#pragma once

#include <omnimapper/base/Error.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace omnimapper::base {

/// Writes the lowest `count` bytes of a number (at most 8) to `bytes`, little-endian on any machine.
inline void toBytes(std::uint64_t value, int count, char* bytes) {
  for (int i = 0; i < count; ++i) bytes[i] = static_cast<char>((value >> (8 * i)) & 0xff);
}
/// Reads a number that toBytes() wrote.
inline std::uint64_t fromBytes(const char* bytes, int count) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) value |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  return value;
}

/// The bits of a double, and the double that has given bits.
inline std::uint64_t bitsOf(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}
inline double fromBits(std::uint64_t bits) {
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// Appends numbers to a byte string, little-endian on any machine; doubles keep every bit.
class ByteWriter {
 public:
  void uint(std::uint64_t value, int bytes) {
    char buffer[8];
    toBytes(value, bytes, buffer);
    bytes_.append(buffer, static_cast<std::size_t>(bytes));
  }
  void real(double value) { uint(bitsOf(value), 8); }
  void raw(std::string_view bytes) { bytes_.append(bytes); }
  /// Appends the length in 8 bytes, then the bytes.
  void block(std::string_view bytes) {
    uint(bytes.size(), 8);
    raw(bytes);
  }
  const std::string& bytes() const { return bytes_; }
  /// Returns the bytes written so far and starts with an empty string.
  std::string take() { return std::exchange(bytes_, {}); }

 private:
  std::string bytes_;
};

/// Reads what a ByteWriter wrote. Throws Error(unreadable_input), naming `what`, if the bytes end early.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::string what) : bytes_(bytes), what_(std::move(what)) {}

  std::uint64_t uint(int bytes) { return fromBytes(raw(static_cast<std::uint64_t>(bytes)).data(), bytes); }
  double real() { return fromBits(uint(8)); }
  std::string_view raw(std::uint64_t count) {
    if (count > bytes_.size() - position_) {
      throw Error(ExitCode::unreadable_input, what_ + ": truncated: byte " + std::to_string(position_) +
                                                  " begins an item of " + std::to_string(count) + " bytes, but only " +
                                                  std::to_string(bytes_.size() - position_) +
                                                  " are left. Use another copy of the file.");
    }
    const std::string_view result = bytes_.substr(position_, count);
    position_ += count;
    return result;
  }
  std::string_view block() { return raw(uint(8)); }
  bool atEnd() const { return position_ == bytes_.size(); }
  /// Sets the name that later messages give to what is read.
  void setWhat(std::string what) { what_ = std::move(what); }

 private:
  std::string_view bytes_;
  std::string what_;
  std::uint64_t position_ = 0;
};

}  // namespace omnimapper::base
