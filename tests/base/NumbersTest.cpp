#include <gtest/gtest.h>
#include <omnimapper/base/Numbers.h>

namespace numbers_test {
namespace {

using namespace omnimapper::base;

TEST(Numbers, fixedHasSoManyDecimalsAndNoSignOnZero) {
  EXPECT_EQ(fixed(1.25, 3), "1.250");
  EXPECT_EQ(fixed(-0.0004, 3), "0.000");
  EXPECT_EQ(fixed(-0.0006, 3), "-0.001");
  EXPECT_EQ(fixed(1e15, 0), "1000000000000000");
}

TEST(Numbers, briefIsAsShortAsItsDigitsAllow) {
  EXPECT_EQ(brief(0.05), "0.05");
  EXPECT_EQ(brief(1234567, 3), "1.23e+06");
  EXPECT_EQ(brief(2.0), "2");
}

}  // namespace
}  // namespace numbers_test
