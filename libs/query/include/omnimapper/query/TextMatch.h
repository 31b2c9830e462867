#pragma once

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::query {

/// How well a name fits a text, the best first.
enum class MatchGrade {
  exact,         ///< the same characters
  same_letters,  ///< the same but for capitals, blanks and punctuation
  part,          ///< each word of the text is a word of the name
  other_word,    ///< the name is another word for the text, its singular or its class: "couch", "seats" and "seat"
  near,          ///< similar
};
std::string toString(MatchGrade grade);

/// A name that fits a text.
struct TextMatch {
  MatchGrade grade = MatchGrade::near;
  double cost = 0;   ///< 0 except for `near`: how much the texts differ, about from 0 to 1
  std::string name;  ///< the name that fits
};

/// A text with which names are compared, by counting edits with weights: letters and digits that are easily confused (0
/// and O, 1 and I and l, 8 and B, 5 and S) differ little, and a wrong digit costs twice as much as a wrong letter,
/// because another number is another door. Texts and names are UTF-8; only their first 200 characters are compared.
class AskedText {
 public:
  explicit AskedText(const std::string& text);

  /// How well one name fits; `cost` may exceed kNear, and every name gets a result.
  TextMatch compare(const std::string& name) const;

  /// A name with a larger cost counts as another name.
  static constexpr double kNear = 0.36;

 private:
  std::string text_;
  std::u32string folded_;
  std::vector<std::u32string> words_;
};

/// The name that fits best; an empty one with a cost of 2 if there are no names.
TextMatch bestOf(const AskedText& asked, const std::vector<std::string>& names);

/// Whether a name comes before another in natural order: numbers in names are compared by value, so "9" is before "10".
/// Capitals only matter if nothing else differs.
bool naturallyBefore(const std::string& a, const std::string& b);

}  // namespace omnimapper::query
