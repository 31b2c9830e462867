#pragma once

#include <string>
#include <vector>

namespace omnimapper::query {

/// The characters of UTF-8; bytes that are none count as characters of their own.
std::u32string charactersOf(const std::string& text);

/// In small letters, with one blank between words and none at the ends; punctuation counts as blanks.
std::u32string folded(const std::u32string& text);

/// What stands between blanks of a folded text.
std::vector<std::u32string> wordsOf(const std::u32string& folded_text);

inline bool isDigit(char32_t c) {
  return c >= U'0' && c <= U'9';
}

/// What changes one folded text into another: changes, insertions, deletions and swaps of neighbours, each 1 but as
/// AskedText says.
double editCost(const std::u32string& a, const std::u32string& b);

/// Length of the longest text that is left of both by leaving out characters.
std::size_t commonSubsequence(const std::u32string& a, const std::u32string& b);

}  // namespace omnimapper::query
