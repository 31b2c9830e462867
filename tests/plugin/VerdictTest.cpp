#include <gtest/gtest.h>
#include <omnimapper/plugin/Verdict.h>

namespace omnimapper::mapper::verdict_test {
namespace {

using Says = Evidence::Says;
using Answer = Verdict::Answer;

const Evidence kGood{"crossed_percent", 0.1, Says::good, "0.1 % of the beams pass through walls"};
const Evidence kSilent{"refused", 3, Says::good, ""};
const Evidence kTooLittle{"revisited_m", 0, Says::too_little, "the robot never came back"};
const Evidence kAgainst{"crossed_percent", 3, Says::against_it, "3 % of the beams pass through walls"};

TEST(Verdict, IsSuspiciousForAnythingAgainstTheMapWhateverElseThereIs) {
  const auto verdict = conclude({kGood, kAgainst, kTooLittle});
  EXPECT_EQ(verdict.answer, Answer::suspicious);
  EXPECT_EQ(sentenceOf(verdict), "The map is suspicious: 3 % of the beams pass through walls.");
  EXPECT_EQ(verdict.evidence.size(), 3u);
}

TEST(Verdict, CannotTellWhereSomethingIsMissing) {
  const auto verdict = conclude({kGood, kTooLittle});
  EXPECT_EQ(verdict.answer, Answer::cannot_tell);
  EXPECT_EQ(sentenceOf(verdict), "The run cannot tell whether the map is right: the robot never came back.");
}

TEST(Verdict, TakesWhatAnotherPluginKnowsInPlaceOfTooLittle) {
  const Evidence revisited{"revisited_m", 12, Says::good, ""};
  EXPECT_EQ(conclude({kTooLittle, revisited}).answer, Answer::consistent);
  EXPECT_EQ(conclude({kTooLittle, revisited}).evidence.size(), 1u);
  EXPECT_EQ(conclude({revisited, kTooLittle}).answer, Answer::consistent) << "whichever plugin speaks first";
  EXPECT_EQ(conclude({revisited, kTooLittle}).evidence.size(), 1u);
  EXPECT_EQ(conclude({kAgainst, kGood}).answer, Answer::suspicious);
}

TEST(Verdict, CannotTellWhereNobodyJudges) {
  EXPECT_EQ(conclude({}).answer, Answer::cannot_tell);
  EXPECT_EQ(sentenceOf(conclude({})), "The run cannot tell whether the map is right: no plugin checks maps.");
}

TEST(Verdict, IsConsistentWhereAllIsGood) {
  const auto verdict = conclude({kGood, kSilent});
  EXPECT_EQ(verdict.answer, Answer::consistent);
  EXPECT_EQ(sentenceOf(verdict), "The map is consistent: 0.1 % of the beams pass through walls.");
}

}  // namespace
}  // namespace omnimapper::mapper::verdict_test
