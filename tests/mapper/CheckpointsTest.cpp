#include <gtest/gtest.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>

#include "run/Checkpoints.h"

namespace omnimapper::mapper::checkpoints_test {
namespace {

// A run that localizes in the checkpoint of a killed run writes no checkpoint itself.
TEST(Checkpoints, oneThatAnotherRunWroteStays) {
  const testing::ScratchFolder folder;
  std::ofstream(folder / "checkpoint.omnimap") << "all that is left of a map";
  std::ofstream(folder / "map.omnimap") << "another map";
  Checkpoints(folder / "checkpoint.omnimap", 60).removeFor(folder / "map.omnimap");
  EXPECT_TRUE(std::filesystem::exists(folder / "checkpoint.omnimap"));
}

}  // namespace
}  // namespace omnimapper::mapper::checkpoints_test
