#include <gtest/gtest.h>
#include <omnimapper/matching/ScanView.h>

namespace omnimapper::matching::scan_view_test {
namespace {

using Eigen::Vector2f;
using Seen = ScanView::Seen;

// A wall 3 m ahead of the laser, which stands at (1, 2) and looks along y.
ScanView wallAhead() {
  ScanWithNormals scan;
  for (int i = -20; i <= 20; ++i) scan.points.emplace_back(3, 0.1F * static_cast<float>(i));
  return {{1, 2, 3.14159265358979 / 2}, Vector2f(0, 0), scan};
}

TEST(ScanView, TellsWhatBeamsPassedAndWhereTheyEnded) {
  const auto view = wallAhead();
  EXPECT_EQ(view.at({1, 4}, 0.2F), Seen::free) << "2 m ahead";
  EXPECT_EQ(view.at({1, 5.1F}, 0.2F), Seen::occupied) << "3.1 m ahead";
  EXPECT_EQ(view.at({1, 6}, 0.2F), Seen::hidden) << "behind the wall";
  EXPECT_EQ(view.at({1, 0}, 0.2F), Seen::unknown) << "behind the laser";
  EXPECT_FLOAT_EQ(view.distance({1, 4}), 2);
}

TEST(ScanView, TheLaserNeedNotBeAtTheOriginOfTheScan) {
  ScanWithNormals scan;
  for (int i = -20; i <= 20; ++i) scan.points.emplace_back(3, 0.1F * static_cast<float>(i));
  const ScanView view({0, 0, 0}, Vector2f(1, 0), scan);
  EXPECT_FLOAT_EQ(view.distance({3, 0}), 2);
  EXPECT_EQ(view.at({2.5F, 0}, 0.2F), Seen::free);
}

TEST(ScanView, AnEmptyScanSawNothing) {
  EXPECT_EQ(ScanView({0, 0, 0}, Vector2f(0, 0), {}).at({1, 0}, 0.2F), Seen::unknown);
}

}  // namespace
}  // namespace omnimapper::matching::scan_view_test
