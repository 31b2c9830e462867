#include "run/PerceivedLog.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/source/ExternalImages.h>

#include <algorithm>

#include "OneSensor.h"

namespace omnimapper::mapper {

namespace {

using mrpt::obs::CObservation;

// Largest number of observations of one stamp that are kept together: more than any robot has sensors. It bounds the
// memory for a log whose clock stands still.
constexpr std::size_t kMostTogether = 64;

bool isRepeatOf(const CObservation& a, const CObservation& b) {
  return a.timestamp == b.timestamp && isOfOneSensor(a, b);
}

}  // namespace

void PerceivedLog::add(PerceptionLine::Perceived perceived) {
  const auto stamp = perceived.raw->timestamp;
  if (!group_.empty() && (group_.front().raw->timestamp != stamp || group_.size() == kMostTogether)) writeGroup();
  group_.push_back(std::move(perceived));
}

void PerceivedLog::finish() {
  writeGroup();
  if (errors_.first() && !has_succeeded_) throw *errors_.first();
  warn();
}

void PerceivedLog::writeGroup() {
  for (auto& [raw, outcomes] : group_) {
    if (request_.with_raw) rawlog_.add(*source::withImagesInside(raw));
    std::vector<CObservation::Ptr> all;
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      if (!outcomes[i].wanted) continue;
      write(outcomes[i], *raw, result_.extractors[i]);
      all.insert(all.end(), outcomes[i].derived.begin(), outcomes[i].derived.end());
    }
    if (request_.show) request_.show(*raw, all);
  }
  group_.clear();
  written_.clear();
}

void PerceivedLog::write(Outcome& outcome, const CObservation& raw, PerceptionResult::Count& count) {
  if (outcome.error) {
    ++count.failed;
    return errors_.add(*outcome.error, raw);
  }
  has_succeeded_ = true;
  count.taken += !outcome.derived.empty();
  count.unchanged += outcome.unchanged;
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

// With `with_raw`, the input's own observations are written, including those that an earlier run derived.
bool PerceivedLog::bringsAlready(const CObservation& derived) const {
  return request_.with_raw &&
         std::any_of(group_.begin(), group_.end(), [&](const Entry& entry) { return isRepeatOf(*entry.raw, derived); });
}

bool PerceivedLog::isWritten(const CObservation& derived) const {
  return std::any_of(written_.begin(), written_.end(), [&](const auto& other) { return isRepeatOf(*other, derived); });
}

void PerceivedLog::warn() {
  auto& warnings = result_.warnings;
  if (errors_.count() > 0) warnings.push_back(errors_.sentence());
  if (in_log_ > 0)
    warnings.push_back(base::counted(in_log_, "derived observation") + " " + base::wasOrWere(in_log_) +
                       " in the log already and not written a second time; without " +
                       "--with-raw all are derived again");
  if (repeated_ > 0)
    warnings.push_back(base::counted(repeated_, "derived observation") + " " + base::wasOrWere(repeated_) +
                       " left out because another one has the same label and stamp, first " + first_repeated_ +
                       "; name only one of these extractors in [perception] extractors");
  if (result_.code == base::ExitCode::ok) result_.code = errors_.code();
}

}  // namespace omnimapper::mapper
