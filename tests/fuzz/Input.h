#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>

namespace omnimapper::fuzz {

/// Reads the bytes of a fuzzer from front to back as numbers. After their end all numbers are 0. Do not take two
/// numbers as arguments of one call, since the compiler may choose which is taken first.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : next_(data), left_(size) {}

  bool atEnd() const { return left_ == 0; }
  std::size_t left() const { return left_; }
  const std::uint8_t* rest() const { return next_; }

  template <class Number>
  Number take() {
    Number number{};
    const std::size_t count = std::min(left_, sizeof number);
    if (count > 0) std::memcpy(&number, next_, count);
    next_ += count;
    left_ -= count;
    return number;
  }

  bool flag() { return (take<std::uint8_t>() & 1) != 0; }
  /// A number from 0 to end - 1.
  int below(int end) { return static_cast<int>(take<std::uint16_t>() % static_cast<unsigned>(end)); }

  /// A number between the two, uniformly distributed, from two bytes.
  double between(double low, double high) { return low + (high - low) * take<std::uint16_t>() / 65535.0; }

  /// Mostly a number between the two, sometimes one that a broken file or driver would have, or any 8 bytes.
  double oddBetween(double low, double high) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr double kOdd[] = {std::numeric_limits<double>::quiet_NaN(),
                               0,
                               kInfinity,
                               -1,
                               -kInfinity,
                               1e-300,
                               -1e-9,
                               1e9,
                               1e38,
                               -1e38,
                               1e300,
                               -1e300};
    const int kind = take<std::uint8_t>();
    if (kind < 200) return between(low, high);
    if (kind < 240) return kOdd[static_cast<std::size_t>(kind) % std::size(kOdd)];
    return take<double>();
  }

 private:
  const std::uint8_t* next_;
  std::size_t left_;
};

}  // namespace omnimapper::fuzz
