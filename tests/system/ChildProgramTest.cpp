// How the tests watch a program that they have started.
#include <gtest/gtest.h>
#include <omnimapper/testing/ChildProgram.h>
#include <signal.h>

#include <memory>
#include <thread>

namespace {

using omnimapper::testing::Program;
using omnimapper::testing::runProgram;

TEST(ChildProgram, IsKilledWhenItHasComputedForLongerThanItsLimit) {
  const auto ended = runProgram({"sh", "-c", "while :; do :; done"}, {0.5, 0});
  EXPECT_FALSE(ended.in_time);
  EXPECT_GT(ended.own_seconds, 0.5);
  EXPECT_LE(ended.own_seconds, ended.seconds);
}

TEST(ChildProgram, IsKilledWhenItHasWaitedForLongerThanItsLimit) {
  const auto ended = runProgram({"sleep", "1000"}, {0.5, 0});
  EXPECT_FALSE(ended.in_time);
  EXPECT_GT(ended.own_seconds, 0.5);
}

TEST(ChildProgram, MayWaitForACoreForLongerThanItsLimit) {
  std::vector<std::unique_ptr<Program>> others;
  for (unsigned i = 0; i < 2 * std::thread::hardware_concurrency(); ++i)
    others.push_back(std::make_unique<Program>(std::vector<std::string>{"sh", "-c", "while :; do :; done"}));
  // The shell ends after a second on a core, which beside the others takes more than two.
  const auto ended = runProgram({"sh", "-c", "ulimit -t 1; while :; do :; done"}, {2, 0});
  EXPECT_TRUE(ended.in_time);
  EXPECT_LT(ended.own_seconds, ended.seconds - 0.5);
}

TEST(ChildProgram, IsIdleOnceItAndWhatItStartedWait) {
  Program program({"sh", "-c",
                   "trap 'kill $!; exit' TERM; i=0; while [ $i -lt 300000 ]; do i=$((i + 1)); done; echo counted; "
                   "sleep 1000 & wait; echo woken"});
  EXPECT_TRUE(program.waitUntilIdle());
  program.send(SIGTERM);
  EXPECT_EQ(program.wait().out, "counted\n");
  EXPECT_FALSE(program.waitUntilIdle()) << "it has ended";
}

}  // namespace
