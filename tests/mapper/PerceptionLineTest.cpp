#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <omnimapper/base/Stamp.h>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "run/PerceptionLine.h"

namespace omnimapper::mapper::perception_line_test {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationComment;

CObservationComment::Ptr comment(const std::string& text, double seconds, const std::string& label = "pen") {
  auto made = CObservationComment::Create();
  made->text = text;
  made->timestamp = base::stampFromUnix(seconds);
  made->sensorLabel = label;
  return made;
}

// New are texts that differ from the last new one.
class OtherText : public perception::Novelty {
 public:
  bool isNew(const CObservation& raw) override {
    const auto& text = dynamic_cast<const CObservationComment&>(raw).text;
    auto& last = last_[raw.sensorLabel];
    const bool is_new = text != last;
    last = text;
    return is_new;
  }

 private:
  std::map<std::string, std::string> last_;
};

// Copies texts with a running number; "bad" is an error, and empty texts are not wanted.
class Copy : public perception::Extractor {
 public:
  bool wants(const CObservation& raw) const override {
    return !dynamic_cast<const CObservationComment&>(raw).text.empty();
  }
  std::vector<CObservation::Ptr> extract(const CObservation& raw) const override {
    ++calls;
    const auto& text = dynamic_cast<const CObservationComment&>(raw).text;
    if (text == "bad") throw base::Error(base::ExitCode::unreadable_input, "a bad text");
    auto made = comment(text + "!", 0, raw.sensorLabel + ".copy");
    made->timestamp = raw.timestamp;
    return {made};
  }
  std::unique_ptr<perception::Novelty> novelty() const override {
    return is_patient ? std::make_unique<OtherText>() : nullptr;
  }

  bool is_patient = true;
  mutable std::atomic<int> calls = 0;
};

struct Result {
  int calls = 0;                   // of the extractor
  std::vector<std::string> texts;  // with their seconds; "-" if not wanted, "error" after an error
  std::size_t unchanged = 0;
};

Result through(bool is_patient, int threads, const std::vector<CObservation::Ptr>& log) {
  auto copy = std::make_unique<Copy>();
  copy->is_patient = is_patient;
  const auto* asked = copy.get();
  std::vector<Named<perception::Extractor>> extractors;
  extractors.push_back({"copy", std::move(copy)});
  PerceptionLine line(extractors, threads);
  Result result;
  const auto take = [&] {
    const auto perceived = line.take();
    const auto& outcome = perceived.outcomes.at(0);
    result.unchanged += outcome.unchanged;
    if (!outcome.wanted) return result.texts.push_back("-");
    if (outcome.error) return result.texts.push_back("error");
    const auto& made = dynamic_cast<const CObservationComment&>(*outcome.derived.at(0));
    EXPECT_EQ(made.timestamp, perceived.raw->timestamp);
    EXPECT_EQ(made.sensorLabel, perceived.raw->sensorLabel + ".copy");
    result.texts.push_back(made.text);
  };
  for (const auto& raw : log) {
    if (line.isFull()) take();
    line.add(raw);
  }
  while (!line.isEmpty()) take();
  result.calls = asked->calls;
  return result;
}

TEST(PerceptionLine, WhatShowsNothingNewGetsWhatWasMadeBefore) {
  const std::vector<CObservation::Ptr> log{comment("a", 1),    comment("a", 2),           comment("", 3),
                                           comment("a", 4),    comment("b", 5),           comment("a", 6, "pencil"),
                                           comment("b", 7),    comment("a", 8, "pencil"), comment("bad", 9),
                                           comment("bad", 10), comment("a", 11)};
  const std::vector<std::string> expected{"a!", "a!", "-", "a!", "b!", "a!", "b!", "a!", "error", "error", "a!"};
  for (const int threads : {1, 2, 4}) {
    const auto result = through(true, threads, log);
    EXPECT_EQ(result.texts, expected);
    EXPECT_EQ(result.unchanged, 5U) << "seconds 2, 4, 7, 8 and 10";
    EXPECT_EQ(result.calls, 5);
  }
}

TEST(PerceptionLine, WithoutAJudgeOfWhatIsNewEverythingIs) {
  const auto result = through(false, 2, {comment("a", 1), comment("a", 2), comment("a", 3)});
  EXPECT_EQ(result.texts, std::vector<std::string>(3, "a!"));
  EXPECT_EQ(result.unchanged, 0U);
  EXPECT_EQ(result.calls, 3);
}

}  // namespace
}  // namespace omnimapper::mapper::perception_line_test
