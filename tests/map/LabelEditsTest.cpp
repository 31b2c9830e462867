#include <gtest/gtest.h>

#include "omnimapper/map/LabelEdits.h"

namespace omnimapper::map::label_edits_test {
namespace {

using Words = std::vector<std::string>;

TEST(LabelEdits, ACommandOfWordsIsReadAsTheseWords) {
  EXPECT_EQ(LabelEdits::commandOf({"name", "0:2", "bed = sofa"}), "name 0:2 = bed = sofa");
  EXPECT_EQ(namedLandmark("name 0:2 = bed = sofa")->text, "bed = sofa");
  EXPECT_EQ(LabelEdits::commandOf({"rename", " bed ", "= b"}), "rename bed = = b");
  EXPECT_EQ(LabelEdits::commandOf({"delete", "a = b"}), "delete a = b");
  EXPECT_EQ(LabelEdits::commandOf({"undo"}), "undo");
  LabelEdits edits;
  for (const char* text : {"bed", "a = b"}) {
    Label label;
    label.text = text;
    edits.add(label);
  }
  EXPECT_TRUE(edits.edit("rename bed = = b").is_done);
  EXPECT_EQ(edits.now().labels[0].text, "= b");
  EXPECT_TRUE(edits.edit("delete a = b").is_done);
  EXPECT_EQ(edits.now().labels.size(), 1U);
}

TEST(LabelEdits, WordsThatWouldBeMisreadAreNoCommand) {
  const std::string too_long(201, 'x');
  for (const auto& words :
       {Words{}, Words{"rename", "a =", "b"}, Words{"rename", "a = b", "c"}, Words{"rename", "a"},
        Words{"rename", "", "b"}, Words{"rename", "a", "b\nc"}, Words{"rename", too_long, "b"}, Words{"delete"},
        Words{"delete", " "}, Words{"delete", "a\x1b[2J"}, Words{"name", "0:2 = x", "y"}, Words{"name", "bed", "x"},
        Words{"name", "-1:2", "x"}, Words{"name", "0:2", ""}, Words{"name", "0:2", too_long},
        Words{"name", "1", "2", "spot"}, Words{"undo", "x"}, Words{"burn"}})
    EXPECT_EQ(LabelEdits::commandOf(words), "") << ::testing::PrintToString(words);
}

}  // namespace
}  // namespace omnimapper::map::label_edits_test
