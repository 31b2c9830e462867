#include <gtest/gtest.h>
#include <omnimapper/plugin/SharedResults.h>

namespace omnimapper::mapper::shared_results_test {
namespace {

TEST(SharedResults, eachKeyOfATypeIsComputedOnce) {
  SharedResults shared;
  int computed = 0;
  const auto get = [&](const std::string& key) { return *shared.get<int>(key, [&] { return 10 * ++computed; }); };
  EXPECT_EQ(get("fine"), 10);
  EXPECT_EQ(get("fine"), 10);
  EXPECT_EQ(get("coarse"), 20);
  EXPECT_EQ(*shared.get<std::string>("fine", [] { return std::string("a text"); }), "a text") << "of another type";
  EXPECT_EQ(computed, 2);
}

}  // namespace
}  // namespace omnimapper::mapper::shared_results_test
