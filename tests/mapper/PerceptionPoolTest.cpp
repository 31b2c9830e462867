#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/mapper/PerceptionPool.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace omnimapper::mapper {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationComment;

CObservationComment::Ptr comment(const std::string& text) {
  auto made = CObservationComment::Create();
  made->text = text;
  return made;
}

// Gives the text of a comment with a suffix, after a while that differs from one to the next. Throws on "bad".
class Suffix : public Extractor {
 public:
  explicit Suffix(std::string suffix) : suffix_(std::move(suffix)) {}
  bool wants(const CObservation& raw) const override {
    return dynamic_cast<const CObservationComment*>(&raw) != nullptr;
  }
  std::vector<CObservation::Ptr> extract(const CObservation& raw) const override {
    const auto& text = dynamic_cast<const CObservationComment&>(raw).text;
    if (text == "bad") throw std::runtime_error("cannot read this one");
    std::this_thread::sleep_for(std::chrono::microseconds(std::hash<std::string>()(text) % 300));
    return {comment(text + suffix_)};
  }

 private:
  std::string suffix_;
};

std::vector<std::string> texts(const PerceptionPool::Derived& derived) {
  std::vector<std::string> all;
  for (const auto& one : derived) all.push_back(dynamic_cast<const CObservationComment&>(*one).text);
  return all;
}

class Pool : public ::testing::TestWithParam<int> {};

TEST_P(Pool, GivesTheSameResultsInTheSameOrderWithAnyNumberOfThreads) {
  const Suffix one(".one"), two(".two");
  PerceptionPool pool({&one, &two}, GetParam());
  std::vector<std::future<PerceptionPool::Derived>> results;
  for (int i = 0; i < 200; ++i) results.push_back(pool.submit(comment(std::to_string(i))));
  for (int i = 0; i < 200; ++i) {
    const std::string name = std::to_string(i);
    EXPECT_EQ(texts(results[static_cast<std::size_t>(i)].get()),
              (std::vector<std::string>{name + ".one", name + ".two"}));
  }
}

TEST_P(Pool, AnExceptionComesOutOfItsFutureAndOfNoOther) {
  const Suffix one(".one");
  PerceptionPool pool({&one}, GetParam());
  auto before = pool.submit(comment("a")), bad = pool.submit(comment("bad")), after = pool.submit(comment("b"));
  EXPECT_EQ(texts(before.get()), std::vector<std::string>{"a.one"});
  EXPECT_THROW(bad.get(), std::runtime_error);
  EXPECT_EQ(texts(after.get()), std::vector<std::string>{"b.one"});
}

TEST_P(Pool, FinishesWhatWasSubmittedBeforeItEnds) {
  std::vector<std::future<PerceptionPool::Derived>> results;
  const Suffix one(".one");
  {
    PerceptionPool pool({&one}, GetParam());
    for (int i = 0; i < 50; ++i) results.push_back(pool.submit(comment(std::to_string(i))));
  }
  for (auto& result : results) EXPECT_EQ(result.get().size(), 1U);
}

TEST_P(Pool, WhatNoExtractorWantsGivesNothing) {
  const Suffix one(".one");
  PerceptionPool pool({&one}, GetParam());
  const auto odometry = mrpt::obs::CObservationOdometry::Create();
  EXPECT_FALSE(pool.wants(*odometry));
  EXPECT_TRUE(pool.wants(*comment("a")));
  EXPECT_TRUE(pool.submit(odometry).get().empty());
}

INSTANTIATE_TEST_SUITE_P(Threads, Pool, ::testing::Values(1, 2, 4));

TEST(PoolWithoutExtractors, GivesNothingAndNeedsNoThread) {
  PerceptionPool pool({}, 2);
  EXPECT_FALSE(pool.wants(*comment("a")));
  EXPECT_TRUE(pool.submit(comment("a")).get().empty());
}

}  // namespace
}  // namespace omnimapper::mapper
