#include "Format.h"

#include <cmath>
#include <cstdio>

namespace omnimapper::check {

std::string significant(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string fixed(double value, int decimals) {
  constexpr double kLarge = 1e7;  // beyond it all digits are noise
  if (std::abs(value) >= kLarge) return significant(value);
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  const std::string written = text;
  const bool is_zero = written.find_first_not_of("-0.") == std::string::npos;
  return is_zero && written[0] == '-' ? written.substr(1) : written;
}

std::string percent(double share) {
  const double value = 100 * share;
  return fixed(value, (value > 0 && value < 1) || (value > 99 && value < 100) ? 1 : 0) + " %";
}

std::string quoted(const std::string& label) {
  return label.empty() ? "(no label)" : "'" + label + "'";
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

}  // namespace omnimapper::check
