#include <omnimapper/query/TextMatch.h>

#include <algorithm>
#include <tuple>

#include "Letters.h"

namespace omnimapper::query {

namespace {

constexpr std::size_t kLongest = 200;   // largest number of characters that are compared
constexpr std::size_t kMostWords = 32;  // largest number of words of a name that are compared
constexpr double kPartOfName = 0.05;    // cost of a name with more words
constexpr std::size_t kShortestAbbreviation = 3;

std::u32string beginningOf(const std::string& text) {
  return charactersOf(text).substr(0, kLongest);
}

double relativeCost(const std::u32string& a, const std::u32string& b) {
  const auto longer = static_cast<double>(std::max(a.size(), b.size()));
  return longer > 0 ? editCost(a, b) / longer : 0;
}

// "conf" for "conference", "ktchn" for "kitchen": the characters of the text appear in this order in the name, and both
// have the same first character. A number must not be shortened.
double abbreviationCost(const std::u32string& text, const std::u32string& name) {
  constexpr double kFar = 1, kLeast = 0.15, kOfMissing = 0.3, kLeastShare = 0.4;
  const bool has_digit = std::any_of(text.begin(), text.end(), isDigit);
  if (has_digit || text.size() < kShortestAbbreviation || text.front() != name.front()) return kFar;
  const double share = static_cast<double>(text.size()) / static_cast<double>(name.size());
  if (share < kLeastShare || commonSubsequence(text, name) < text.size()) return kFar;
  return kLeast + kOfMissing * (1 - share);
}

double wordCost(const std::u32string& text, const std::u32string& name) {
  return std::min(relativeCost(text, name), abbreviationCost(text, name));
}

// Each word of the text is compared with the nearest word of the name; longer words have more weight.
double costOfWords(const std::vector<std::u32string>& text, const std::vector<std::u32string>& name) {
  double sum = 0, length = 0;
  for (const auto& word : text) {
    double least = 1;
    for (std::size_t i = 0; i < std::min(name.size(), kMostWords); ++i)
      least = std::min(least, wordCost(word, name[i]));
    sum += least * static_cast<double>(word.size());
    length += static_cast<double>(word.size());
  }
  return length > 0 ? sum / length : 1;
}

bool isPart(const std::vector<std::u32string>& text, const std::vector<std::u32string>& name) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [&](const auto& word) {
    return std::find(name.begin(), name.end(), word) != name.end();
  });
}

bool hasDigit(const std::u32string& word) {
  return std::any_of(word.begin(), word.end(), isDigit);
}

// Replaces letters that are easily confused with digits, except for a letter at the end, which distinguishes doors with
// the same number.
std::u32string asNumber(std::u32string word) {
  for (std::size_t i = 0; i < word.size(); ++i) {
    const bool is_last = i + 1 == word.size() && i > 0;
    switch (word[i]) {
      case U'o':
        word[i] = U'0';
        break;
      case U'i':
      case U'l':
        word[i] = U'1';
        break;
      case U's':
        if (!is_last) word[i] = U'5';
        break;
      case U'b':
        if (!is_last) word[i] = U'8';
        break;
      default:
        break;
    }
  }
  return word;
}

std::u32string joined(const std::vector<std::u32string>& words) {
  std::u32string all;
  for (const auto& word : words) all += word;
  return all;
}

// Another number is another door: each number and each single letter of the text must occur in the name.
bool hasNumbersOf(const std::vector<std::u32string>& text, const std::vector<std::u32string>& name) {
  return std::all_of(text.begin(), text.end(), [&](const std::u32string& word) {
    if (!hasDigit(word) && word.size() > 1) return true;
    return std::any_of(name.begin(), name.end(),
                       [&](const std::u32string& other) { return asNumber(word) == asNumber(other); });
  });
}

// Compares texts of digits by their numbers; returns a value below, at or above zero.
int compareNumbers(std::u32string_view a, std::u32string_view b) {
  while (a.size() > 1 && a.front() == U'0') a.remove_prefix(1);
  while (b.size() > 1 && b.front() == U'0') b.remove_prefix(1);
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  return a.compare(b);
}

}  // namespace

std::string toString(MatchGrade grade) {
  switch (grade) {
    case MatchGrade::exact:
      return "exact";
    case MatchGrade::same_letters:
      return "same letters";
    case MatchGrade::part:
      return "part";
    case MatchGrade::other_word:
      return "other word";
    case MatchGrade::near:
      break;
  }
  return "near";
}

AskedText::AskedText(const std::string& text)
    : text_(text), folded_(folded(beginningOf(text))), words_(wordsOf(folded_)) {}

TextMatch AskedText::compare(const std::string& name) const {
  if (name == text_) return {MatchGrade::exact, 0, name};
  const std::u32string other = folded(beginningOf(name));
  if (folded_.empty() || other.empty()) return {MatchGrade::near, 1, name};
  if (other == folded_) return {MatchGrade::same_letters, 0, name};
  const auto words = wordsOf(other);
  const bool has_number = std::any_of(words_.begin(), words_.end(), hasDigit);
  // Blanks between digits separate numbers: "1 12" is not "11 2".
  if (!has_number && joined(words_) == joined(words)) return {MatchGrade::same_letters, 0, name};
  if (isPart(words_, words)) return {MatchGrade::part, 0, name};
  double cost = relativeCost(folded_, other);
  cost = std::min(cost, costOfWords(words_, words) + (words.size() == words_.size() ? 0 : kPartOfName));
  if (!has_number) return {MatchGrade::near, cost, name};
  constexpr double kSameNumber = 0.1, kNumberAndMore = 0.3, kOtherNumber = 0.5;
  if (asNumber(joined(words_)) == asNumber(joined(words))) return {MatchGrade::near, std::min(cost, kSameNumber), name};
  const bool is_same = hasNumbersOf(words_, words);  // "room 213" is 213
  return {MatchGrade::near, is_same ? std::min(cost, kNumberAndMore) : std::max(cost, kOtherNumber), name};
}

TextMatch bestOf(const AskedText& asked, const std::vector<std::string>& names) {
  TextMatch best{MatchGrade::near, 2, ""};
  for (const auto& name : names) {
    const TextMatch match = asked.compare(name);
    if (std::tie(match.grade, match.cost) < std::tie(best.grade, best.cost)) best = match;
  }
  return best;
}

bool naturallyBefore(const std::string& a, const std::string& b) {
  const std::u32string left = folded(beginningOf(a)), right = folded(beginningOf(b));
  std::size_t i = 0, j = 0;
  while (i < left.size() && j < right.size()) {
    if (isDigit(left[i]) && isDigit(right[j])) {
      const auto digitsFrom = [](const std::u32string& text, std::size_t begin) {
        const auto end = std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(begin), text.end(), isDigit);
        return std::u32string_view(text).substr(begin, static_cast<std::size_t>(end - text.begin()) - begin);
      };
      const auto of_left = digitsFrom(left, i), of_right = digitsFrom(right, j);
      if (const int order = compareNumbers(of_left, of_right); order != 0) return order < 0;
      i += of_left.size();
      j += of_right.size();
      continue;
    }
    if (left[i] != right[j]) return left[i] < right[j];
    ++i;
    ++j;
  }
  if (left.size() - i != right.size() - j) return left.size() - i < right.size() - j;
  return a < b;
}

}  // namespace omnimapper::query
