#include "G2oTokens.h"

#include <omnimapper/base/Error.h>

#include <charconv>
#include <cmath>

namespace omnimapper::graph {

std::string_view G2oTokens::word() {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  std::size_t begin = 0;
  while (begin < rest_.size() && is_space(rest_[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest_.size() && !is_space(rest_[end])) ++end;
  const std::string_view found = rest_.substr(begin, end - begin);
  rest_.remove_prefix(end);
  return found;
}

double G2oTokens::number() {
  std::string_view text = word();
  if (text.empty()) fail("the line ends where a number is expected");
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    fail("\"" + std::string(text) + "\" is no finite number");
  return value;
}

std::int64_t G2oTokens::id() {
  const std::string_view text = word();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    fail("\"" + std::string(text) + "\" is no vertex number");
  return value;
}

void G2oTokens::fail(const std::string& what) const {
  throw base::Error(base::ExitCode::damaged_input,
                    file_ + ":" + std::to_string(number_) + ": " + what + ": correct the line or use an intact copy");
}

}  // namespace omnimapper::graph
