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

}  // namespace
}  // namespace omnimapper::base
