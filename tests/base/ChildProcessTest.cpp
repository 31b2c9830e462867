#include <gtest/gtest.h>
#include <omnimapper/base/ChildProcess.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <stdexcept>

namespace omnimapper::base {
namespace {

constexpr std::uint64_t kMemory = std::uint64_t{64} << 20;

TEST(ChildProcess, WhatTheWorkChangesStaysInTheChild) {
  int number = 1;
  EXPECT_EQ(tryInChild([&] { number = 2; }, kMemory).how, ChildOutcome::How::finished);
  EXPECT_EQ(number, 1);
}

TEST(ChildProcess, ReportsHowTheWorkEnded) {
  const auto thrown = tryInChild([] { throw std::runtime_error("a reason"); }, kMemory);
  EXPECT_EQ(thrown.how, ChildOutcome::How::threw);
  EXPECT_EQ(thrown.message, "a reason");
  EXPECT_EQ(tryInChild([] { throw std::bad_alloc(); }, kMemory).how, ChildOutcome::How::out_of_memory);
  EXPECT_EQ(tryInChild([] { ::raise(SIGSEGV); }, kMemory).how, ChildOutcome::How::crashed);
  EXPECT_EQ(tryInChild([] { ::_exit(1); }, kMemory).how, ChildOutcome::How::crashed) << "as a sanitizer ends a crash";
  EXPECT_EQ(tryInChild([] { ::_exit(77); }, kMemory).how, ChildOutcome::How::crashed);
}

TEST(ChildProcess, AMessageLongerThanThePipeHoldsIsHeardWhole) {
  const std::string message(300'000, 'a');
  EXPECT_EQ(tryInChild([&] { throw std::runtime_error(message); }, kMemory).message, message);
}

TEST(ChildProcess, IsHeardWhileItWorksAndEndedWithItsOwner) {
  std::string said;
  {
    ChildProcess child(
        [](int to_parent) {
          if (::write(to_parent, "on", 2) != 2) return 1;
          ::pause();
          return 0;
        },
        kMemory);
    while (said.empty()) child.hear(said, 1000);
    EXPECT_EQ(said, "on");
    EXPECT_FALSE(child.hear(said, 0));
    EXPECT_FALSE(child.isOver());
  }
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "no child is left";
}

TEST(ChildProcess, StatusIsThatOfItsEnd) {
  ChildProcess child([](int) { return 3; }, kMemory);
  std::string said;
  while (!child.isOver()) child.hear(said, -1);
  EXPECT_EQ(WEXITSTATUS(child.status()), 3);
  EXPECT_EQ(WEXITSTATUS(child.status()), 3) << "however often it is asked";
}

}  // namespace
}  // namespace omnimapper::base
