// The share of scripts/fuzz runs that every run of the tests makes, from fixed numbers: those that once found
// something, and the first few.
#include <gtest/gtest.h>
#include <omnimapper/obs/registerClasses.h>
#include <omnimapper/testing/Fixtures.h>

#include "Trials.h"

namespace omnimapper::fuzz {
namespace {

// A sanitizer makes a program slower, and takes memory of its own.
const Bounds kBounds = testing::kIsSanitized ? Bounds{120, 8192} : Bounds{};

void expectNoComplaints(Wrong wrong, const std::vector<std::uint64_t>& numbers) {
  obs::registerClasses();
  const testing::ScratchFolder scratch;
  const Trials trials(wrong, testing::ownProgram("."), scratch.path());
  for (const auto number : numbers) {
    const auto trial = trials.make(number, scratch / "trial");
    const auto ended = testing::runProgram(trial.command, {kBounds.seconds + 1});
    const auto why = complaint(ended, kBounds);
    EXPECT_FALSE(why) << kNamesOfWrong[static_cast<std::size_t>(wrong)] << " " << number << " (" << trial.name
                      << "): " << *why << "\n"
                      << toString(ended);
  }
}

TEST(Runs, OnLogsOfWrongValuesEndAsDocumented) {
  expectNoComplaints(Wrong::logs, {1840, 1867, 2176, 2444, 2836, 3870, 1, 2, 3, 4, 5, 6});
}

TEST(Runs, OnMapsOfFittingChecksumsEndAsDocumented) {
  expectNoComplaints(Wrong::maps, {282, 299, 671, 959, 998, 1017, 1044, 1625, 1, 2, 3});
}

TEST(Runs, OnWrongInisEndAsDocumented) {
  expectNoComplaints(Wrong::inis, {1, 2, 3, 4, 5, 6});
}

TEST(Runs, OnWrongFoldersEndAsDocumented) {
  expectNoComplaints(Wrong::folders, {1, 2, 3, 4, 5, 6});
}

TEST(Runs, ATrialIsMadeOfItsNumberAlone) {
  const Observations log = testing::SimulatedLog().observations();
  Dice one(7), same(7), other(8);
  const auto bytes = mutatedLog(log, one);
  EXPECT_EQ(bytes, mutatedLog(log, same));
  EXPECT_NE(bytes, mutatedLog(log, other));
}

}  // namespace
}  // namespace omnimapper::fuzz
