#pragma once

#include <charconv>
#include <string>

namespace omnimapper::plugins {

/// Decimal text with that many decimals, whatever the locale.
inline std::string fixed(double value, int decimals) {
  char text[512];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals).ptr;
  return {text, end};
}

/// Decimal text with so many significant digits, as short as that allows.
inline std::string brief(double value, int digits = 4) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  return {text, end};
}

}  // namespace omnimapper::plugins
