#include "run/LiveTrace.h"

#include <omnimapper/live/HostClock.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace omnimapper::mapper {

namespace {

using Kind = live::JournalEvent::Kind;

constexpr double kShortest = 1e-3, kStep = 1.05;  // [s] the shortest latency, and the ratio of consecutive bins

}  // namespace

void LatencyCounts::add(double latency) {
  const double step = std::ceil(std::log(std::max(latency, kShortest) / kShortest) / std::log(kStep));
  ++counts_[static_cast<std::size_t>(std::min(step, static_cast<double>(kSteps - 1)))];
  ++all_;
}

double LatencyCounts::quantile(double quantile) const {
  if (all_ == 0) return 0;
  std::uint64_t below = 0;
  for (std::size_t step = 0; step < kSteps; ++step) {
    below += counts_[step];
    if (static_cast<double>(below) >= quantile * static_cast<double>(all_))
      return kShortest * std::pow(kStep, static_cast<double>(step));
  }
  return kShortest * std::pow(kStep, static_cast<double>(kSteps - 1));
}

void LiveSchedule::mapped(base::Stamp stamp) {
  trace_->latencies.add(base::secondsBetween(stamp, live::hostNow()));
}

bool LiveSchedule::takesBundleBeforeEnd(const FrameBundle& oldest, std::size_t) {
  const bool is_done = std::all_of(oldest.observations.begin(), oldest.observations.end(), [](const auto& made) {
    return made.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
  if (is_done) trace_->note(Kind::bundle);
  return is_done;
}

bool LiveSchedule::takesJobBeforeEnd(bool, bool is_done) {
  if (is_done) trace_->note(Kind::job);
  return is_done;
}

}  // namespace omnimapper::mapper
