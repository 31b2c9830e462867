#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "front_end/Perception.h"

namespace omnimapper::mapper::perception_test {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationComment;

CObservationComment::Ptr comment(const std::string& text) {
  auto made = CObservationComment::Create();
  made->text = text;
  return made;
}

// Returns the text of a comment with a suffix, after a varying delay. Throws on "bad".
class Suffix : public perception::Extractor {
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

using Result = PerceivedParts;

// Texts of the derived observations, after the observation itself.
std::vector<std::string> texts(const Result& result) {
  std::vector<std::string> all;
  for (std::size_t i = 1; i < result.parts.size(); ++i) {
    all.push_back(dynamic_cast<const CObservationComment&>(*result.parts[i].observation).text);
  }
  return all;
}

class Pool : public ::testing::TestWithParam<int> {};

TEST_P(Pool, GivesTheSameResultsInTheSameOrderWithAnyNumberOfThreads) {
  const Suffix one(".one"), two(".two");
  base::WorkerPool workers(GetParam());
  const Perception perception({&one, &two}, {}, workers, {});
  std::vector<std::future<Result>> results;
  for (int i = 0; i < 200; ++i) results.push_back(perception.submit(comment(std::to_string(i))));
  for (int i = 0; i < 200; ++i) {
    const std::string name = std::to_string(i);
    EXPECT_EQ(texts(results[static_cast<std::size_t>(i)].get()),
              (std::vector<std::string>{name + ".one", name + ".two"}));
  }
}

TEST_P(Pool, AnExceptionComesOutOfItsFutureAndOfNoOther) {
  const Suffix one(".one");
  base::WorkerPool workers(GetParam());
  const Perception perception({&one}, {}, workers, {});
  auto before = perception.submit(comment("a")), bad = perception.submit(comment("bad")),
       after = perception.submit(comment("b"));
  EXPECT_EQ(texts(before.get()), std::vector<std::string>{"a.one"});
  EXPECT_THROW(bad.get(), std::runtime_error);
  EXPECT_EQ(texts(after.get()), std::vector<std::string>{"b.one"});
}

TEST_P(Pool, AnObservationThatAnExtractorCannotTakeIsCountedAndTheOthersTakeIt) {
  class Strict : public Suffix {
   public:
    using Suffix::Suffix;
    std::vector<CObservation::Ptr> extract(const CObservation&) const override {
      throw base::Error(base::ExitCode::missing_images, "no picture");
    }
  };
  const Strict strict(".one");
  const Suffix two(".two");
  base::WorkerPool workers(GetParam());
  const Perception perception({&strict, &two}, {}, workers, {});
  const auto result = perception.submit(comment("a")).get();
  EXPECT_EQ(texts(result), std::vector<std::string>{"a.two"});
  EXPECT_EQ(result.errors.count(), 1U);
  EXPECT_EQ(result.errors.code(), base::ExitCode::missing_images);
}

TEST_P(Pool, WhatTheLogBringsIsNotMadeAnew) {
  class Named : public Suffix {
   public:
    using Suffix::Suffix;
    std::vector<perception::DerivedName> namesOf(const CObservation& raw) const override {
      return {{CLASS_ID(CObservationComment), raw.sensorLabel + ".x"},
              {CLASS_ID(CObservationComment), raw.sensorLabel + ".y"}};
    }
  };
  const Named named(".one");
  base::WorkerPool workers(GetParam());
  const Perception perception({&named}, {}, workers, {});
  const auto labelled = [](const std::string& label) {
    auto made = comment("brought");
    made->sensorLabel = label;
    return made;
  };
  const auto raw = labelled("raw"), x = labelled("raw.x"), y = labelled("raw.y");
  auto other_class = mrpt::obs::CObservationOdometry::Create();
  other_class->sensorLabel = "raw.y";
  EXPECT_TRUE(texts(perception.submit(raw, {raw, x, y}).get()).empty());
  EXPECT_EQ(texts(perception.submit(raw, {raw, x}).get()).size(), 1U) << "a part of it is not all";
  EXPECT_EQ(texts(perception.submit(raw, {raw, x, other_class}).get()).size(), 1U);
}

TEST_P(Pool, WhatHasNotBegunAtTheEndIsLeftOutAndItsFutureSaysSo) {
  std::vector<std::future<Result>> results;
  const Suffix one(".one");
  auto workers = std::make_unique<base::WorkerPool>(GetParam());
  const Perception perception({&one}, {}, *workers, {});
  for (int i = 0; i < 200; ++i) results.push_back(perception.submit(comment(std::to_string(i))));
  workers.reset();  // before the objects that its tasks use
  bool left_out = false;
  for (auto& result : results) {
    try {
      EXPECT_EQ(texts(result.get()).size(), 1U);
      EXPECT_FALSE(left_out) << "they are done in order";
    } catch (const std::future_error&) {
      left_out = true;
    }
  }
}

// Prepares the length of a comment's text.
class Counter : public MeasurementPlugin {
 public:
  struct Length : Prepared {
    std::size_t length;
  };
  bool wants(const CObservation& observation) const override {
    return dynamic_cast<const CObservationComment*>(&observation) != nullptr;
  }
  std::unique_ptr<const Prepared> prepare(const CObservation& observation) const override {
    auto prepared = std::make_unique<Length>();
    prepared->length = dynamic_cast<const CObservationComment&>(observation).text.size();
    return prepared;
  }
  Batch measure(const map::KeyFrame&, const Observed&, const View&) override { return {}; }
};

TEST_P(Pool, PluginsPrepareWhatTheyWantOfTheRawAndTheDerived) {
  const Suffix one(".one");
  const Counter counter;
  base::WorkerPool workers(GetParam());
  const Perception perception({&one}, {&counter}, workers, {});
  const auto result = perception.submit(comment("abc")).get().parts;
  ASSERT_EQ(result.size(), 2U);
  const auto length = [&](std::size_t i) {
    return dynamic_cast<const Counter::Length&>(*result[i].prepared.front()).length;
  };
  EXPECT_EQ(length(0), 3U);
  EXPECT_EQ(length(1), 7U);
  EXPECT_EQ(perception.submit(mrpt::obs::CObservationOdometry::Create()).get().parts.front().prepared.front(), nullptr);
}

// Counts on the blackboard how often the raw observation was looked at.
class Looker : public Suffix {
 public:
  struct Looked {
    std::size_t before;
  };
  using Suffix::Suffix;
  std::vector<CObservation::Ptr> extractUsing(const CObservation& raw, perception::Blackboard& board) const override {
    std::size_t before = 0;
    board.find<Looked>([&](const Looked& one) { return before = one.before + 1, false; });
    board.put(std::make_shared<const Looked>(Looked{before}));
    return {comment(dynamic_cast<const CObservationComment&>(raw).text + std::to_string(before))};
  }
};

TEST_P(Pool, TheExtractorsOfAChainShareWhatTheyMadeOfOneObservation) {
  const Looker one("one"), two("two");
  base::WorkerPool workers(GetParam());
  const Perception perception({&one, &two}, {}, workers, {});
  std::vector<std::future<Result>> results;
  for (int i = 0; i < 50; ++i) results.push_back(perception.submit(comment("n")));
  for (auto& result : results) EXPECT_EQ(texts(result.get()), (std::vector<std::string>{"n0", "n1"}));
  perception::Blackboard board;
  board.put(std::make_shared<const Looker::Looked>(Looker::Looked{6}));
  EXPECT_EQ(texts(perception.submit(comment("n"), {}, board).get()), (std::vector<std::string>{"n7", "n8"}))
      << "as a pose plugin has looked at it";
}

TEST_P(Pool, WhatNoExtractorWantsGivesNothing) {
  const Suffix one(".one");
  base::WorkerPool workers(GetParam());
  const Perception perception({&one}, {}, workers, {});
  const auto odometry = mrpt::obs::CObservationOdometry::Create();
  EXPECT_FALSE(perception.wants(*odometry));
  EXPECT_TRUE(perception.wants(*comment("a")));
  EXPECT_EQ(perception.submit(odometry).get().parts.size(), 1U) << "itself";
}

INSTANTIATE_TEST_SUITE_P(Threads, Pool, ::testing::Values(1, 2, 4));

}  // namespace
}  // namespace omnimapper::mapper::perception_test
