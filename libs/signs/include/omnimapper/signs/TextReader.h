#pragma once

#include <omnimapper/camera/ColourImage.h>

#include <string>
#include <vector>

namespace omnimapper::signs {

/// The result of reading a line of text.
struct Reading {
  std::string text;                   ///< UTF-8
  std::vector<double> probabilities;  ///< of each letter, as the reader reports it, 0 to 1
  /// Where the reader's likeliest letter is not in the alphabet, the reader takes another letter or none. This is the
  /// smallest probability of the letters taken instead, 0 if a letter was left out, and 1 if neither happened.
  double of_left_out = 1;
};

/// Reads one line of text.
class TextReader {
 public:
  virtual ~TextReader() = default;
  /// `patch` is BGR, upright, and shows only the line. Thread-safe.
  virtual Reading read(const camera::ColourImage& patch) const = 0;
};

/// The letters that a text may consist of. Some letters outside of the alphabet are replaced by a letter of it.
class Alphabet {
 public:
  /// `letters` in UTF-8. Middle dots and dashes are read as hyphens if the alphabet has the hyphen.
  explicit Alphabet(const std::string& letters);
  /// The letter of the alphabet as which `letter` is read; empty if there is none.
  std::string letterFor(const std::string& letter) const;
  /// All letters and the blank.
  const std::vector<std::string>& letters() const { return letters_; }

  /// Letters of the English alphabet, digits, and the punctuation of signs.
  static const char* common();

 private:
  std::vector<std::string> letters_;
};

/// The letters of a text in UTF-8, one by one; bytes that are not valid UTF-8 are left out.
std::vector<std::string> lettersOf(const std::string& text);

}  // namespace omnimapper::signs
