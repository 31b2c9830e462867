#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

namespace omnimapper::base {

/// The number with `decimals` decimals, whatever the locale; zero has no minus sign.
inline std::string fixed(double value, int decimals) {
  char text[512];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals).ptr;
  const bool zero = std::string_view(text, end - text).find_first_not_of("-0.") == std::string_view::npos;
  return {zero && text[0] == '-' ? text + 1 : text, end};
}

/// The number rounded to `digits` significant digits, without trailing zeros; very large and very small numbers get an
/// exponent.
inline std::string brief(double value, int digits = 4) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  return {text, end};
}

/// "1 scan", "2 scans".
inline std::string counted(std::uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// "was" for one, "were" for any other number.
inline std::string wasOrWere(std::uint64_t count) {
  return count == 1 ? "was" : "were";
}

}  // namespace omnimapper::base
