#pragma once

#include <omnimapper/obs/CObservationDoorSigns.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// The text on a sign, in the form in which signs are compared.
struct SignText {
  std::string number;              ///< the first line with a digit, without blanks, in capitals; empty if there is none
  std::vector<std::string> words;  ///< the other lines, in capitals, from the top
  double confidence = 0;           ///< of the number, or, without a number, of the most certain line

  bool empty() const { return number.empty() && words.empty(); }
};

/// The text of a sign, without lines whose confidence is below `min_confidence`.
SignText textOf(const obs::ObservedDoorSign& sign, double min_confidence);

/// Length of the longest common subsequence of two texts, divided by the length of the longer text, both in UTF-8
/// bytes: 0 to 1 (thesis 3.5.3.3).
double likeness(const std::string& a, const std::string& b);

/// Whether two texts can be of the same sign.
enum class Agreement {
  contradicts,  ///< different numbers, or words that are not similar
  unknown,      ///< one has only a number, the other only words: one sign may have both
  partly,       ///< one has a number that the other lacks; their words are similar
  agrees        ///< same number, or, if neither has a number, words with a likeness above 60 %
};
Agreement agreementOf(const SignText& a, const SignText& b);

/// Whether one text may be a misreading or a new version of the other: the likeness of their numbers is above 60 %.
bool mayBeMisread(const SignText& a, const SignText& b);

/// Whether the text is probably on one sign only: it has a number of three or more digits that is not a time.
bool isOfOneSign(const SignText& text);

/// Prior odds that two signs whose texts agree are the same sign, before their positions are considered. A number of
/// three digits is on another sign by chance once in 1000, a number of four digits once in 10000. Words, times and
/// numbers with fewer than three digits are often on several signs.
double oddsOfOneSign(const SignText& a, const SignText& b);

}  // namespace omnimapper::plugins
