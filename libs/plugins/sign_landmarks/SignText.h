#pragma once

#include <omnimapper/obs/CObservationDoorSigns.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// What is written on a sign, as far as it tells signs apart.
struct SignText {
  std::string number;              ///< the first line with a digit, without blanks, in capitals; empty if none has one
  std::vector<std::string> words;  ///< the other lines, in capitals, from the top
  double confidence = 0;           ///< that the number was read right, or, without one, the surest line

  bool empty() const { return number.empty() && words.empty(); }
};

/// Lines that are less sure than `min_confidence` are left out.
SignText textOf(const obs::ObservedDoorSign& sign, double min_confidence);

/// Share of the longer text that is their longest common subsequence, 0 to 1 (thesis 3.5.3.3); bytes of UTF-8 count.
double likeness(const std::string& a, const std::string& b);

/// How far two texts can be of one sign.
enum class Agreement {
  contradicts,  ///< other numbers, or words that are not alike
  unknown,      ///< one tells a number alone, the other words: both may stand on one sign
  partly,       ///< one tells a number that the other lacks; their words are alike
  agrees        ///< the same number, or, where neither has one, words that are alike by more than 60 %
};
Agreement agreementOf(const SignText& a, const SignText& b);

/// Whether one may be the other misread or rewritten: numbers that are alike by more than 60 %.
bool mayBeMisread(const SignText& a, const SignText& b);

/// Whether hardly two signs say so: a number of three digits or more that is no time.
bool isOfOneSign(const SignText& text);

/// How many times likelier than not two signs of which the texts agree are one, before it is known where they are. A
/// number of three digits stands on another sign by chance once in 1000, one of four once in 10000. Words, times, dates
/// and other numbers below 100 often stand on several.
double oddsOfOneSign(const SignText& a, const SignText& b);

}  // namespace omnimapper::plugins
