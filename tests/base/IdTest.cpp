#include <gtest/gtest.h>
#include <omnimapper/base/Id.h>

#include <map>
#include <sstream>
#include <unordered_set>

namespace omnimapper::base::id_test {
namespace {

TEST(Id, OrdersBySessionThenIndexWhichIsTheOrderOfCommit) {
  const std::map<VariableId, int> by_id{{{1, 0}, 2}, {{0, 7}, 1}, {{0, 2}, 0}};
  int expected = 0;
  for (const auto& [id, position] : by_id) EXPECT_EQ(position, expected++) << id;
}

TEST(Id, DistinguishesSessionsAndIndicesInHashTablesToo) {
  std::unordered_set<KeyFrameId> ids{{0, 1}, {1, 0}, {1, 1}, {0, 0}};
  EXPECT_EQ(ids.size(), 4u);
  EXPECT_EQ(ids.count({1, 0}), 1u);
  EXPECT_EQ(ids.count({2, 0}), 0u);
}

TEST(Id, PrintsSessionAndIndex) {
  EXPECT_EQ(toString(FactorId{3, 41}), "3:41");
  std::ostringstream out;
  out << LandmarkId{0, 65536};
  EXPECT_EQ(out.str(), "0:65536");
}

TEST(Id, OfDifferentThingsAreDifferentTypes) {
  EXPECT_FALSE((std::is_convertible_v<VariableId, FactorId>));
  EXPECT_FALSE((std::is_convertible_v<KeyFrameId, LandmarkId>));
}

}  // namespace
}  // namespace omnimapper::base::id_test
