#include "Letters.h"

#include <algorithm>
#include <array>

namespace omnimapper::query {

namespace {

// Number of bytes of the character that begins there; 1 for a byte that is not valid UTF-8.
std::size_t lengthAt(const std::string& text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 1;
  for (std::size_t i = 1; i < length; ++i)
    if (at + i >= text.size() || (static_cast<unsigned char>(text[at + i]) & 0xc0) != 0x80) return 1;
  return length;
}

// The lower case of a Latin, Greek or Cyrillic letter.
char32_t small(char32_t c) {
  const bool is_times = c == 0xd7;
  if ((c >= U'A' && c <= U'Z') || (c >= 0xc0 && c <= 0xde && !is_times)) return c + 0x20;
  if ((c >= 0x391 && c <= 0x3a9) || (c >= 0x410 && c <= 0x42f)) return c + 0x20;
  const bool pairs_from_even = (c >= 0x100 && c <= 0x137) || (c >= 0x14a && c <= 0x177);
  return pairs_from_even ? c | 1 : c;
}

bool isBlank(char32_t c) {
  const bool is_letter = (c >= U'a' && c <= U'z') || isDigit(c) || c >= 0xaa;
  return !is_letter || c == 0xa0;
}

// One representative of the lower-case letters and digits that are confused with each other.
char32_t lookOf(char32_t c) {
  switch (c) {
    case U'o':
      return U'0';
    case U'i':
    case U'l':
      return U'1';
    case U'b':
      return U'8';
    case U's':
      return U'5';
    default:
      return c;
  }
}

constexpr double kDigit = 2, kBlank = 0.5, kConfused = 0.2;

double changeCost(char32_t a, char32_t b) {
  if (a == b) return 0;
  const bool are_digits = isDigit(a) && isDigit(b);
  if (lookOf(a) == lookOf(b)) return kConfused;
  return are_digits ? kDigit : 1;
}

double missingCost(char32_t c) {
  return isDigit(c) ? kDigit : c == U' ' ? kBlank : 1;
}

}  // namespace

std::u32string charactersOf(const std::string& text) {
  std::u32string characters;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = lengthAt(text, at);
    constexpr std::array<unsigned char, 5> kOfLead{0, 0xff, 0x1f, 0x0f, 0x07};
    char32_t code = static_cast<unsigned char>(text[at]) & kOfLead[length];
    for (std::size_t i = 1; i < length; ++i) code = code << 6 | (static_cast<unsigned char>(text[at + i]) & 0x3f);
    characters += code;
    at += length;
  }
  return characters;
}

std::u32string folded(const std::u32string& text) {
  std::u32string result;
  for (const char32_t c : text) {
    const char32_t letter = small(c);
    if (!isBlank(letter)) {
      result += letter;
    } else if (!result.empty() && result.back() != U' ') {
      result += U' ';
    }
  }
  if (!result.empty() && result.back() == U' ') result.pop_back();
  return result;
}

std::vector<std::u32string> wordsOf(const std::u32string& folded_text) {
  std::vector<std::u32string> words;
  bool begins = true;
  for (const char32_t c : folded_text) {
    if (c == U' ') {
      begins = true;
      continue;
    }
    if (begins) words.emplace_back();
    begins = false;
    words.back() += c;
  }
  return words;
}

double editCost(const std::u32string& a, const std::u32string& b) {
  std::vector<double> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  for (std::size_t j = 0; j < b.size(); ++j) row[j + 1] = row[j] + missingCost(b[j]);
  for (std::size_t i = 0; i < a.size(); ++i) {
    next[0] = row[0] + missingCost(a[i]);
    for (std::size_t j = 0; j < b.size(); ++j) {
      double& cost = next[j + 1];
      cost = std::min({row[j] + changeCost(a[i], b[j]), row[j + 1] + missingCost(a[i]), next[j] + missingCost(b[j])});
      const bool is_swap = i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j];
      if (is_swap) cost = std::min(cost, before[j - 1] + 1);
    }
    before.swap(row);
    row.swap(next);
  }
  return row.back();
}

std::size_t commonSubsequence(const std::u32string& a, const std::u32string& b) {
  std::vector<std::size_t> row(b.size() + 1), next(b.size() + 1);
  for (const char32_t c : a) {
    for (std::size_t j = 0; j < b.size(); ++j) next[j + 1] = c == b[j] ? row[j] + 1 : std::max(row[j + 1], next[j]);
    row.swap(next);
  }
  return row.back();
}

}  // namespace omnimapper::query
