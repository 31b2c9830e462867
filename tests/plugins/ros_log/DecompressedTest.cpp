#include <gtest/gtest.h>

#include "LogWriters.h"
#include "ros_log/decompressed.h"

namespace omnimapper::ros::decompressed_test {
namespace {

using ros_test::packed;

TEST(RosDecompressed, tellsWhatIsLargerThanItStates) {
  const std::string bytes(100'000, 'x');
  for (const char* compression : {"none", "bz2", "lz4", "zstd"}) {
    const std::string in = packed(compression, bytes);
    const auto whole = decompressed(compression, in, bytes.size());
    EXPECT_EQ(whole.problem, "") << compression;
    EXPECT_EQ(whole.bytes, bytes) << compression;
    EXPECT_EQ(decompressed(compression, in, bytes.size() + 1).problem, "") << compression;
    EXPECT_EQ(decompressed(compression, in, bytes.size() - 1).problem, "is larger than it states") << compression;
  }
}

}  // namespace
}  // namespace omnimapper::ros::decompressed_test
