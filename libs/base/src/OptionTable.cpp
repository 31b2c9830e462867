#include <omnimapper/base/OptionTable.h>

#include <charconv>
#include <cmath>
#include <cstdio>

namespace omnimapper::base::option_text {

namespace {
bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

template <class Number>
bool parseWhole(const std::string& text, Number& value) {
  const bool skips_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const char* begin = text.data() + (skips_plus ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(begin, end, value);
  return result.ec == std::errc() && result.ptr == end && begin != end;
}

template <class Number>
std::unique_ptr<BadValue> parseBounded(const std::string& text, const Range& range, const char* what, Number& value) {
  Number parsed{};
  if (!parseWhole(text, parsed) || !std::isfinite(static_cast<double>(parsed))) {
    return std::make_unique<BadValue>(BadValue{BadValue::Kind::type, what});
  }
  if (static_cast<double>(parsed) < range.low || static_cast<double>(parsed) > range.high) {
    return std::make_unique<BadValue>(BadValue{BadValue::Kind::range, format(range)});
  }
  value = parsed;
  return nullptr;
}
}  // namespace

bool isAngleInDegrees(const std::string& key) {
  return endsWith(key, "_deg");
}

std::string format(double value) {
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  // The fewest digits that a person would have written: 12 hide the rounding of degrees to radians and back.
  char text[40];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

std::string format(const std::vector<std::string>& names) {
  std::string joined;
  for (const auto& name : names) joined += (joined.empty() ? "" : ", ") + name;
  return joined;
}

std::string format(const Range& range) {
  const bool open_low = std::isinf(range.low), open_high = std::isinf(range.high);
  if (open_low && open_high) return "";
  if (open_high && range.low == Range::positive().low) return "> 0";
  if (open_high) return ">= " + format(range.low);
  if (open_low) return "<= " + format(range.high);
  return "[" + format(range.low) + ", " + format(range.high) + "]";
}

std::unique_ptr<BadValue> parse(const std::string& text, const Range& range, double& value) {
  return parseBounded(text, range, "a number", value);
}

std::unique_ptr<BadValue> parse(const std::string& text, const Range& range, int& value) {
  return parseBounded(text, range, "a whole number", value);
}

std::unique_ptr<BadValue> parse(const std::string& text, bool& value) {
  for (const char* yes : {"true", "yes", "1"}) {
    if (text == yes) return value = true, nullptr;
  }
  for (const char* no : {"false", "no", "0"}) {
    if (text == no) return value = false, nullptr;
  }
  return std::make_unique<BadValue>(BadValue{BadValue::Kind::type, "true or false"});
}

std::vector<std::string> parseList(const std::string& text) {
  std::vector<std::string> names;
  std::string name;
  for (const char c : text + ",") {
    if (c == ',' || c == ' ' || c == '\t') {
      if (!name.empty()) names.push_back(name);
      name.clear();
    } else {
      name += c;
    }
  }
  return names;
}

}  // namespace omnimapper::base::option_text
