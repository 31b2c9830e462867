#include "SignText.h"

#include <algorithm>
#include <cctype>

namespace omnimapper::plugins {

namespace {

constexpr double kAlike = 0.6;  // as in the thesis

std::ptrdiff_t digitsIn(const std::string& text) {
  return std::count_if(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

// Only ASCII letters are capitalized; other bytes are kept.
std::string inCapitals(const std::string& text, bool keeps_blanks) {
  std::string result;
  for (const char c : text) {
    if (c == ' ' && !keeps_blanks) continue;
    result += static_cast<unsigned char>(c) < 0x80 ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
  }
  return result;
}

bool haveWordsAlike(const SignText& a, const SignText& b) {
  return std::any_of(a.words.begin(), a.words.end(), [&](const std::string& word) {
    return std::any_of(b.words.begin(), b.words.end(),
                       [&](const std::string& other) { return likeness(word, other) > kAlike; });
  });
}

}  // namespace

SignText textOf(const obs::ObservedDoorSign& sign, double min_confidence) {
  SignText text;
  double surest_word = 0;
  for (const auto& line : sign.texts) {
    if (line.confidence < min_confidence || line.text.empty()) continue;
    if (text.number.empty() && digitsIn(line.text) > 0) {
      text.number = inCapitals(line.text, false);
      text.confidence = line.confidence;
    } else {
      text.words.push_back(inCapitals(line.text, true));
      surest_word = std::max(surest_word, line.confidence);
    }
  }
  if (text.number.empty()) text.confidence = surest_word;
  return text;
}

double likeness(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return 0;
  std::vector<std::size_t> before(b.size() + 1), now(b.size() + 1);
  for (const char letter : a) {
    for (std::size_t i = 0; i < b.size(); ++i)
      now[i + 1] = letter == b[i] ? before[i] + 1 : std::max(before[i + 1], now[i]);
    std::swap(before, now);
  }
  return static_cast<double>(before.back()) / static_cast<double>(std::max(a.size(), b.size()));
}

Agreement agreementOf(const SignText& a, const SignText& b) {
  if (!a.number.empty() && !b.number.empty()) return a.number == b.number ? Agreement::agrees : Agreement::contradicts;
  if (a.number.empty() && b.number.empty()) return haveWordsAlike(a, b) ? Agreement::agrees : Agreement::contradicts;
  if (a.words.empty() || b.words.empty()) return Agreement::unknown;
  return haveWordsAlike(a, b) ? Agreement::partly : Agreement::contradicts;
}

bool mayBeMisread(const SignText& a, const SignText& b) {
  return likeness(a.number, b.number) > kAlike;
}

bool isOfOneSign(const SignText& text) {
  return text.number.find(':') == std::string::npos && digitsIn(text.number) >= 3;
}

double oddsOfOneSign(const SignText& a, const SignText& b) {
  constexpr double kOften = 0.1, kThreeDigits = 100, kMoreDigits = 1000;
  if (a.number != b.number || !isOfOneSign(a)) return kOften;
  return digitsIn(a.number) == 3 ? kThreeDigits : kMoreDigits;
}

}  // namespace omnimapper::plugins
