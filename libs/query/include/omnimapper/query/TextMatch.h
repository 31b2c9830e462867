#pragma once

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::query {

/// How well a name fits a text, the best first.
enum class MatchGrade {
  exact,         ///< they are the same
  same_letters,  ///< but for capitals, blanks and punctuation
  part,          ///< each word of the text is a word of the name
  near,          ///< they are alike
};
std::string toString(MatchGrade grade);

/// A name that fits a text.
struct TextMatch {
  MatchGrade grade = MatchGrade::near;
  double cost = 0;   ///< 0 but for `near`: what is different, as a share of the longer text
  std::string name;  ///< that fits
};

/// A text that names are compared with. Comparing is by weighted edits: letters and digits that are easily confused (0
/// and O, 1 and I and l, 8 and B, 5 and S) differ little, and two digits differ by more than two letters, for another
/// number is another door. Texts and names are UTF-8; of longer ones the first 200 characters count.
class AskedText {
 public:
  explicit AskedText(const std::string& text);

  /// How it fits one name; `cost` may be beyond kNear, and no name is too far for that.
  TextMatch compare(const std::string& name) const;

  /// What is further counts as another name.
  static constexpr double kNear = 0.36;

 private:
  std::string text_;
  std::u32string folded_;
  std::vector<std::u32string> words_;
};

/// Whether a name comes before another: numbers in them count as numbers, so "9" is before "10". Capitals do not count
/// unless nothing else differs.
bool naturallyBefore(const std::string& a, const std::string& b);

}  // namespace omnimapper::query
