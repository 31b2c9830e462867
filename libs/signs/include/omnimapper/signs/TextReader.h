#pragma once

#include <omnimapper/perception/ColourImage.h>

#include <string>
#include <vector>

namespace omnimapper::signs {

/// A line of text as a reader reads it.
struct Reading {
  std::string text;                   ///< UTF-8
  std::vector<double> probabilities;  ///< of each letter by the reader's own word, 0 to 1
  /// Least probability of what was taken where the reader saw a letter that the alphabet has not; 1 if it saw none.
  double of_left_out = 1;
};

/// Reads one line of text.
class TextReader {
 public:
  virtual ~TextReader() = default;
  /// `patch` is BGR, upright, and holds the line alone. Thread-safe.
  virtual Reading read(const perception::ColourImage& patch) const = 0;
};

/// What a text may consist of: letters, of which some stand for others.
class Alphabet {
 public:
  /// `letters` in UTF-8. A middle dot is read as a hyphen where the alphabet has one.
  explicit Alphabet(const std::string& letters);
  /// The letter that counts for this one, empty if the alphabet has none.
  std::string letterFor(const std::string& letter) const;
  /// All letters and the blank.
  const std::vector<std::string>& letters() const { return letters_; }

  /// Letters of the English alphabet, digits, and what signs have besides.
  static const char* common();

 private:
  std::vector<std::string> letters_;
};

/// The letters of a text in UTF-8, one by one; bytes that are no UTF-8 are left out.
std::vector<std::string> lettersOf(const std::string& text);

}  // namespace omnimapper::signs
