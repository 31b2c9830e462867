#include "TextColumns.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>

#include <charconv>
#include <cmath>
#include <sstream>

namespace omnimapper::eval {

using base::Error;
using base::ExitCode;

namespace {
template <class Number>
bool parseWhole(const std::string& text, Number& value) {
  const std::size_t skipped = text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data() + skipped, end, value);
  return result.ec == std::errc() && result.ptr == end;
}

// Writes "1.3050e+03" as "1305.0", digit by digit, so that no digit is lost in a double. Text without an exponent, and
// text that is no number, is returned unchanged.
std::string withoutExponent(const std::string& text) {
  const auto e = text.find_first_of("eE");
  int exponent = 0;
  if (e == std::string::npos || !parseWhole(text.substr(e + 1), exponent) || std::abs(exponent) > 30) return text;
  std::string digits = text.substr(0, e);
  const bool negative = digits.rfind('-', 0) == 0;
  if (negative) digits.erase(0, 1);
  auto point = static_cast<int>(std::min(digits.find('.'), digits.size()));
  if (point < static_cast<int>(digits.size())) digits.erase(point, 1);
  point += exponent;
  if (point < 0) digits.insert(0, -point, '0');
  if (point > static_cast<int>(digits.size())) digits.append(point - digits.size(), '0');
  digits.insert(std::max(point, 0), ".");
  const auto first = std::min(digits.find_first_not_of('0'), digits.find('.'));
  return (negative ? "-" : "") + digits.substr(first);
}
}  // namespace

void TextColumns::expect(std::size_t count, const std::string& names) const {
  if (texts.size() == count) return;
  throw Error(ExitCode::unreadable_input, at + "expected " + std::to_string(count) + " columns (" + names +
                                              "), found " + std::to_string(texts.size()));
}

double TextColumns::number(std::size_t column) const {
  double value = 0;
  if (!parseWhole(texts[column], value) || !std::isfinite(value)) {
    throw Error(ExitCode::unreadable_input,
                at + "column " + std::to_string(column + 1) + ", '" + texts[column] + "', is no finite number");
  }
  return value;
}

base::Stamp TextColumns::stamp(std::size_t column) const {
  try {
    return base::parseUnix(withoutExponent(texts[column]));
  } catch (const Error& error) {
    throw Error(error.code(), at + "column " + std::to_string(column + 1) + ": " + error.what());
  }
}

void forEachLine(const std::string& path, const std::function<bool(const TextColumns&)>& use) {
  auto in = base::openInput(path);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line.substr(0, line.find('#')));
    TextColumns columns{path + ":" + std::to_string(number) + ": ", {}};
    for (std::string word; words >> word;) columns.texts.push_back(word);
    if (!columns.texts.empty() && !use(columns)) return;
  }
  if (in.bad()) throw Error(ExitCode::damaged_input, path + ": cannot be read to its end; is the disk whole?");
}

}  // namespace omnimapper::eval
