#include <gtest/gtest.h>
#include <omnimapper/perception/ConnectedComponents.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <string>
#include <vector>

namespace omnimapper::perception::connected_components_test {
namespace {

/// Equal letters belong together; blanks belong to no component.
struct SameLetter {
  const std::string& image;
  bool valid(int pixel) const { return image[static_cast<std::size_t>(pixel)] != ' '; }
  bool similar(int a, int b) const { return image[static_cast<std::size_t>(a)] == image[static_cast<std::size_t>(b)]; }
};

Components componentsOf(const std::string& image, int width) {
  return connectComponents(width, static_cast<int>(image.size()) / width, SameLetter{image});
}

TEST(ConnectedComponents, AreNumberedByTheirFirstPixelAsWorkedByHand) {
  const auto found = componentsOf(
      "a.bb"
      "aab "
      " abb",
      4);
  EXPECT_EQ(found.labels(), (std::vector<int>{1, 2, 3, 3, 1, 1, 3, 0, 0, 1, 3, 3}));
  EXPECT_EQ(found.pixels, (std::vector<int>{4, 1, 5}));
}

TEST(ConnectedComponents, ArmsThatMeetBelowAreOne) {
  const auto found = componentsOf(
      "x x x"
      "x x x"
      "xxxxx",
      5);
  EXPECT_EQ(found.pixels, std::vector<int>{11});
}

TEST(ConnectedComponents, PixelsThatTouchAtACornerAreTwo) {
  EXPECT_EQ(componentsOf("x  x", 2).pixels, (std::vector<int>{1, 1}));
}

TEST(ConnectedComponents, SmallOnesCanBeLeftOut) {
  EXPECT_EQ(componentsOf("aab", 3).labels(2), (std::vector<int>{1, 1, 0}));
}

TEST(ConnectedComponents, NothingHasNone) {
  EXPECT_TRUE(componentsOf("    ", 2).runs.empty());
  const std::string none;
  EXPECT_TRUE(connectComponents(0, 0, SameLetter{none}).labels().empty());
  EXPECT_TRUE(connectComponents(0, 5, SameLetter{none}).labels().empty());
  EXPECT_TRUE(connectComponents(5, 0, SameLetter{none}).labels().empty());
}

/// Neighbours whose heights differ by at most one: similar, but not transitive.
struct SmallStep {
  const std::vector<int>& heights;
  bool valid(int) const { return true; }
  bool similar(int a, int b) const {
    return std::abs(heights[static_cast<std::size_t>(a)] - heights[static_cast<std::size_t>(b)]) <= 1;
  }
};

std::vector<int> floodFill(const std::vector<int>& heights, int width, int height) {
  std::vector<int> labels(heights.size(), 0), stack;
  int count = 0;
  for (std::size_t start = 0; start < heights.size(); ++start) {
    if (labels[start] != 0) continue;
    labels[start] = ++count;
    stack.push_back(static_cast<int>(start));
    while (!stack.empty()) {
      const int i = stack.back();
      stack.pop_back();
      const auto visit = [&](bool inside, int j) {
        if (!inside || labels[static_cast<std::size_t>(j)] != 0 || !SmallStep{heights}.similar(i, j)) return;
        labels[static_cast<std::size_t>(j)] = count;
        stack.push_back(j);
      };
      visit(i % width > 0, i - 1);
      visit(i % width < width - 1, i + 1);
      visit(i >= width, i - width);
      visit(i / width < height - 1, i + width);
    }
  }
  return labels;
}

TEST(ConnectedComponents, AgreeWithFloodFillOnRandomImages) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    testing::Dice dice(seed);
    const int width = 1 + static_cast<int>(dice.uniform(0, 30)), height = 1 + static_cast<int>(dice.uniform(0, 30));
    std::vector<int> heights(static_cast<std::size_t>(width * height));
    for (int& h : heights) h = static_cast<int>(dice.uniform(0, 5));
    ASSERT_EQ(connectComponents(width, height, SmallStep{heights}).labels(), floodFill(heights, width, height))
        << "seed " << seed;
  }
}

}  // namespace
}  // namespace omnimapper::perception::connected_components_test
