#pragma once

#include <string>
#include <vector>

namespace omnimapper::query {

/// The characters of a UTF-8 text; each invalid byte counts as a character.
std::u32string charactersOf(const std::string& text);

/// The text in lower case, with one blank between words and none at the ends; punctuation counts as blanks.
std::u32string folded(const std::u32string& text);

/// The words of a folded text.
std::vector<std::u32string> wordsOf(const std::u32string& folded_text);

inline bool isDigit(char32_t c) {
  return c >= U'0' && c <= U'9';
}

/// Cost of changing one folded text into another by changes, insertions, deletions and swaps of neighbours; each costs
/// 1 except as AskedText says.
double editCost(const std::u32string& a, const std::u32string& b);

/// Length of the longest common subsequence.
std::size_t commonSubsequence(const std::u32string& a, const std::u32string& b);

}  // namespace omnimapper::query
