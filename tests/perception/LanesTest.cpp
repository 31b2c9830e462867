#include <gtest/gtest.h>

#include <cstdlib>

#include "planes/Lanes.h"

namespace omnimapper::perception::planes::lanes_test {
namespace {

// The variable is read once per process, so the test runs in a separate process. The kernels themselves are compared in
// tests/system/perceive/SameBitsTest.cpp.
TEST(LanesDeathTest, TheEnvironmentSwitchesTheKernelsForAvx2Off) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto ask = [](const char* value) {
    ::setenv("OMNIMAPPER_AVX2", value, 1);
    std::exit(hasAvx2() ? 1 : 0);
  };
  EXPECT_EXIT(ask("0"), ::testing::ExitedWithCode(0), "");
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) {
    EXPECT_EXIT(ask("1"), ::testing::ExitedWithCode(1), "");
  }
#endif
}

}  // namespace
}  // namespace omnimapper::perception::planes::lanes_test
