#include <gtest/gtest.h>
#include <omnimapper/query/TextMatch.h>

#include <algorithm>

#include "Letters.h"

namespace omnimapper::query::text_match_test {
namespace {

double costOf(const std::string& text, const std::string& name) {
  return AskedText(text).compare(name).cost;
}
MatchGrade gradeOf(const std::string& text, const std::string& name) {
  return AskedText(text).compare(name).grade;
}

TEST(TextMatch, EditsCostWhatTheyAreByHand) {
  const auto cost = [](const std::string& a, const std::string& b) {
    return editCost(folded(charactersOf(a)), folded(charactersOf(b)));
  };
  EXPECT_DOUBLE_EQ(cost("kithcen", "kitchen"), 1) << "neighbours swapped";
  EXPECT_DOUBLE_EQ(cost("kitchn", "kitchen"), 1);
  EXPECT_DOUBLE_EQ(cost("kitten", "sitting"), 3);
  EXPECT_DOUBLE_EQ(cost("2l3", "213"), 0.2) << "a letter read for a digit";
  EXPECT_DOUBLE_EQ(cost("SO8", "50B"), 0.6);
  EXPECT_DOUBLE_EQ(cost("219", "213"), 2) << "another number is another door";
  EXPECT_DOUBLE_EQ(cost("21", "213"), 2);
  EXPECT_DOUBLE_EQ(cost("ellastone", "ella stone"), 0.5);
  EXPECT_DOUBLE_EQ(cost("", "abc"), 3);
  EXPECT_EQ(commonSubsequence(U"ktchn", U"kitchen"), 5U);
}

TEST(TextMatch, GradesAreFromTheSameToAlike) {
  EXPECT_EQ(gradeOf("Kitchen", "Kitchen"), MatchGrade::exact);
  EXPECT_EQ(gradeOf("kitchen", "KITCHEN"), MatchGrade::same_letters);
  EXPECT_EQ(gradeOf("ella  stone", "Ella-Stone"), MatchGrade::same_letters);
  EXPECT_EQ(gradeOf("\xc3\xbc"
                    "bung",
                    "\xc3\x9c"
                    "BUNG"),
            MatchGrade::same_letters);
  EXPECT_EQ(gradeOf("stone", "Ella Stone"), MatchGrade::part);
  EXPECT_EQ(gradeOf("stone ella", "Ella Stone"), MatchGrade::part);
  EXPECT_EQ(gradeOf("kithcen", "Kitchen"), MatchGrade::near);
}

TEST(TextMatch, WhatIsMistypedIsNearAndAnotherNumberIsNot) {
  for (const auto& [text, name] : std::vector<std::pair<std::string, std::string>>{{"kithcen", "Kitchen"},
                                                                                   {"2I3", "213"},
                                                                                   {"2O1", "201"},
                                                                                   {"2l3", "2I3"},
                                                                                   {"room 213", "213"},
                                                                                   {"conf", "Conference"},
                                                                                   {"ktchn", "Kitchen"},
                                                                                   {"Strage", "Storage"},
                                                                                   {"ela stone", "Ella Stone"},
                                                                                   {"stoen", "Ella Stone"}})
    EXPECT_LE(costOf(text, name), AskedText::kNear) << text << " for " << name;
  for (const auto& [text, name] : std::vector<std::pair<std::string, std::string>>{{"219", "213"},
                                                                                   {"231", "213"},
                                                                                   {"213A", "213"},
                                                                                   {"21B", "218"},
                                                                                   {"21", "213"},
                                                                                   {"2133", "213"},
                                                                                   {"women", "Kitchen"},
                                                                                   {"xyzzy", "wall"},
                                                                                   {"1", "I0"}})
    EXPECT_GT(costOf(text, name), AskedText::kNear) << text << " for " << name;
}

TEST(TextMatch, TextsWithoutLettersFitOnlyThemselves) {
  EXPECT_EQ(gradeOf("!?", "!?"), MatchGrade::exact);
  EXPECT_GT(costOf("!?", "wall"), AskedText::kNear);
  EXPECT_GT(costOf("wall", ""), AskedText::kNear);
}

TEST(TextMatch, NumbersInNamesCountAsNumbers) {
  std::vector<std::string> names{"213", "9", "marker 12", "marker 2", "Exit", "0100", "98765432109876543210", ""};
  std::sort(names.begin(), names.end(), naturallyBefore);
  EXPECT_EQ(names, (std::vector<std::string>{"", "9", "0100", "213", "98765432109876543210", "Exit", "marker 2",
                                             "marker 12"}));
}

}  // namespace
}  // namespace omnimapper::query::text_match_test
