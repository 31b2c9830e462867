#include <gtest/gtest.h>
#include <omnimapper/base/IniDifferences.h>

namespace omnimapper::base {
namespace {

using Lines = std::vector<std::string>;

TEST(IniDifferences, ofTheSameSettingsThereAreNone) {
  EXPECT_EQ(iniDifferences("[a]\nx = 1\ny = 2\n[b]\nz = 3\n", "[b]\nz = 3\n[a]\ny = 2\nx = 1\n"), Lines());
}

TEST(IniDifferences, nameOtherNewAndMissingKeys) {
  EXPECT_EQ(iniDifferences("[a]\nx = 1\ny = 2\n", "[a]\nx = 5\n[b]\nz = 3\n"),
            Lines({"[a] x (1, was 5)", "[a] y (2, was not set)", "[b] z (not set, was 3)"}));
}

TEST(IniDifferences, sensorsAndSectionsWithoutSettingsDoNotCount) {
  EXPECT_EQ(iniDifferences("[live]\nsensors = laser\n[laser]\ndriver = CHokuyoURG\npose_x = 1\n",
                           "[live_window]\nclass = LiveWindow\n"),
            Lines());
}

TEST(IniDifferences, keysAreComparedByTheirPresentNames) {
  EXPECT_EQ(iniDifferences("[a]\nmin_travel_m = 4\n", "[a]\nmin_way_m = 4\n"), Lines());
  EXPECT_EQ(iniDifferences("[a]\nmin_travel_m = 4\n", "[a]\nmin_way_m = 5\n"), Lines({"[a] min_travel_m (4, was 5)"}));
}

TEST(IniDifferences, numbersAreComparedAsNumbers) {
  EXPECT_EQ(iniDifferences("[a]\nx = 0.50\n", "[a]\nx = 0.5\n"), Lines());
  EXPECT_EQ(iniDifferences("[a]\nx = 1e2\n", "[a]\nx = 100.5\n"), Lines({"[a] x (1e2, was 100.5)"}));
}

TEST(IniDifferences, anotherClassIsAnotherSetting) {
  EXPECT_EQ(iniDifferences("[motion]\nclass = A\n", "[motion]\nclass = B\n"), Lines({"[motion] class (A, was B)"}));
}

}  // namespace
}  // namespace omnimapper::base
