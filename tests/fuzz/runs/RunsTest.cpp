// The few runs of fuzz-runs that are part of the tests. Their numbers are fixed: those that once revealed a defect, and
// the first few.
#include <gtest/gtest.h>
#include <omnimapper/obs/registerClasses.h>
#include <omnimapper/testing/Fixtures.h>

#include "FuzzedRuns.h"

namespace omnimapper::fuzz {
namespace {

// Programs with a sanitizer are slower and need more memory.
const Bounds kBounds = testing::kIsSanitized ? Bounds{120, 8192} : Bounds{};

void expectNoComplaints(Wrong wrong, const std::vector<std::uint64_t>& numbers) {
  obs::registerClasses();
  const testing::ScratchFolder scratch;
  const FuzzedRuns runs(wrong, testing::ownProgram("."), scratch.path());
  for (const auto number : numbers) {
    const auto fuzzed = runs.make(number, scratch / "run");
    const auto ended = testing::runProgram(fuzzed.command, {kBounds.seconds + 1});
    const auto why = complaint(ended, kBounds);
    EXPECT_FALSE(why) << kNamesOfWrong[static_cast<std::size_t>(wrong)] << " " << number << " (" << fuzzed.name
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

TEST(Runs, OfOneNumberHaveTheSameInput) {
  const Observations log = testing::SimulatedLog().observations();
  Dice one(7), same(7), other(8);
  const auto bytes = mutatedLog(log, one);
  EXPECT_EQ(bytes, mutatedLog(log, same));
  EXPECT_NE(bytes, mutatedLog(log, other));
}

}  // namespace
}  // namespace omnimapper::fuzz
