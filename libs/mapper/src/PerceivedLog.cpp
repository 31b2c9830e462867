#include "PerceivedLog.h"

#include <omnimapper/source/ExternalImages.h>

#include <algorithm>

#include "OneSensor.h"

namespace omnimapper::mapper {

namespace {

using mrpt::obs::CObservation;

// Of one stamp; no robot has more sensors, and a log whose clock stands still must not be kept in memory.
constexpr std::size_t kMostTogether = 64;

bool isRepeatOf(const CObservation& a, const CObservation& b) {
  return a.timestamp == b.timestamp && isOfOneSensor(a, b);
}

}  // namespace

void PerceivedLog::add(const CObservation::Ptr& raw, std::vector<Outcome> outcomes) {
  if (!moment_.empty() && (moment_.front().raw->timestamp != raw->timestamp || moment_.size() == kMostTogether))
    writeMoment();
  moment_.push_back({raw, std::move(outcomes)});
}

void PerceivedLog::finish() {
  writeMoment();
  if (first_error_ && !has_succeeded_) throw *first_error_;
  warn();
}

void PerceivedLog::writeMoment() {
  for (auto& [raw, outcomes] : moment_) {
    if (request_.with_raw) rawlog_.add(*source::withImagesInside(raw));
    std::vector<CObservation::Ptr> all;
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      if (!outcomes[i].wanted) continue;
      write(outcomes[i], result_.extractors[i]);
      all.insert(all.end(), outcomes[i].derived.begin(), outcomes[i].derived.end());
    }
    if (request_.show) request_.show(*raw, all);
  }
  moment_.clear();
  written_.clear();
}

void PerceivedLog::write(Outcome& outcome, PerceptionResult::Count& count) {
  if (outcome.error) return fail(*outcome.error, count);
  has_succeeded_ = true;
  count.taken += !outcome.derived.empty();
  for (const auto& derived : outcome.derived) {
    if (bringsAlready(*derived)) {
      ++in_log_;
    } else if (isWritten(*derived)) {
      if (repeated_++ == 0) first_repeated_ = "'" + derived->sensorLabel + "' of [" + count.section + "]";
    } else {
      rawlog_.add(*derived);
      written_.push_back(derived);
      ++count.derived;
    }
  }
}

void PerceivedLog::fail(const base::Error& error, PerceptionResult::Count& count) {
  ++count.failed;
  if (!first_error_) first_error_ = error;
}

// With the observations that were read, those that an earlier run derived are written too.
bool PerceivedLog::bringsAlready(const CObservation& derived) const {
  return request_.with_raw && std::any_of(moment_.begin(), moment_.end(),
                                          [&](const Entry& entry) { return isRepeatOf(*entry.raw, derived); });
}

bool PerceivedLog::isWritten(const CObservation& derived) const {
  return std::any_of(written_.begin(), written_.end(), [&](const auto& other) { return isRepeatOf(*other, derived); });
}

void PerceivedLog::warn() {
  auto& warnings = result_.warnings;
  if (first_error_) {
    std::size_t failed = 0;
    for (const auto& count : result_.extractors) failed += count.failed;
    warnings.push_back(std::to_string(failed) + " times an extractor could not take an observation, which was left " +
                       "out; the first: " + first_error_->what());
  }
  if (in_log_ > 0)
    warnings.push_back(std::to_string(in_log_) +
                       " derived observations are in the log already and were not written a second time; without " +
                       "--with-raw they are made anew");
  if (repeated_ > 0)
    warnings.push_back(std::to_string(repeated_) +
                       " derived observations have the label and stamp of another one and were left out, first " +
                       first_repeated_ + "; name one extractor of them in [perception] extractors");
  if (!first_error_ || result_.code != base::ExitCode::ok) return;
  const bool lacks_images = first_error_->code() == base::ExitCode::missing_images;
  result_.code = lacks_images ? base::ExitCode::missing_images : base::ExitCode::damaged_input;
}

}  // namespace omnimapper::mapper
