#pragma once

#include <omnimapper/base/Numbers.h>

#include <cstddef>
#include <cstdio>
#include <string>

namespace omnimapper::eval {

/// The share as "12.3 %", or "-" if the whole is 0.
inline std::string percent(double part, double whole) {
  return whole > 0 ? base::fixed(100 * part / whole, 1) + " %" : "-";
}

/// A line of a table for a terminal.
inline std::string line(const std::string& name, const std::string& value, const std::string& of) {
  char text[200];
  std::snprintf(text, sizeof text, "  %-44s %9s   %s\n", name.c_str(), value.c_str(), of.c_str());
  return text;
}

inline std::string countLine(const std::string& name, std::size_t part, std::size_t whole) {
  return line(name, percent(static_cast<double>(part), static_cast<double>(whole)),
              std::to_string(part) + " of " + std::to_string(whole));
}

}  // namespace omnimapper::eval
