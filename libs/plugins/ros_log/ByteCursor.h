#pragma once

#include <omnimapper/base/Bytes.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace omnimapper::ros {

/// What is wrong with bytes, as a clause whose subject is what they belong to: "ends too early".
class BadBytes : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads little-endian numbers and texts one after another. Throws BadBytes where the bytes end.
class ByteCursor {
 public:
  explicit ByteCursor(std::string_view bytes) : bytes_(bytes) {}

  std::size_t left() const { return bytes_.size() - at_; }
  std::size_t position() const { return at_; }
  std::string_view raw(std::uint64_t count) {
    if (count > left()) throw BadBytes("ends too early");
    const auto part = bytes_.substr(at_, static_cast<std::size_t>(count));
    at_ += part.size();
    return part;
  }
  std::uint64_t uint(int size) { return base::fromBytes(raw(static_cast<std::uint64_t>(size)).data(), size); }
  /// A text after its length in four bytes.
  std::string_view text() { return raw(uint(4)); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace omnimapper::ros
