#include <omnimapper/base/Error.h>
#include <omnimapper/live/LiveSource.h>

#include <cstdio>
#include <utility>

#include "Arrivals.h"
#include "SensorThread.h"

namespace omnimapper::live {

namespace {

constexpr std::chrono::milliseconds kStep(100);
constexpr std::chrono::milliseconds kToStop(2000);   // a read() takes a tenth of a second, and ending a laser takes one
constexpr std::chrono::milliseconds kToOpen(30000);  // lasers and cameras with motors take up to ten seconds

}  // namespace

std::string toString(SensorMetrics::State state) {
  using State = SensorMetrics::State;
  switch (state) {
    case State::opening:
      return "opening";
    case State::working:
      return "working";
    case State::silent:
      return "silent";
    case State::lost:
      return "lost";
    case State::stopped:
      break;
  }
  return "stopped";
}

struct LiveSource::Parts {
  std::vector<SensorSection> sections;
  LiveOptions options;
  std::shared_ptr<Arrivals> arrivals;
  std::optional<source::ImageSettings> images;  // while sensors are open
  std::vector<SensorThread> threads;
  bool has_left_behind = false, has_reported_failure = false;
};

LiveSource::LiveSource(std::vector<SensorSection> sensors, const LiveOptions& options,
                       std::unique_ptr<Recorder> recorder)
    : parts_(std::make_unique<Parts>()) {
  parts_->sections = std::move(sensors);
  parts_->options = options;
  parts_->arrivals = std::make_shared<Arrivals>(options, std::move(recorder));
}

LiveSource::~LiveSource() {
  close();
}

void LiveSource::open(const std::function<bool()>& stop) {
  try {
    openAll(stop);
  } catch (...) {
    close();
    auto* recorder = parts_->arrivals->recorder();
    if (recorder && counts().arrived == 0) recorder->discard();
    throw;
  }
}

void LiveSource::openAll(const std::function<bool()>& stop) {
  parts_->images.emplace(parts_->options.images);
  parts_->threads.reserve(parts_->sections.size());
  for (const auto& section : parts_->sections) {
    auto& thread = parts_->threads.emplace_back(section, parts_->options, parts_->arrivals);
    thread.start();
    const auto begin = std::chrono::steady_clock::now();
    while (!thread.waitUntilOpen(kStep)) {
      if (std::chrono::steady_clock::now() - begin > kToOpen)
        throw base::Error(base::ExitCode::unreadable_input,
                          section.file + ": sensor [" + section.name + "] (" + section.driver +
                              ") cannot be opened: its driver has not returned for 30 s");
      if (stop && stop())
        throw base::Error(base::ExitCode::interrupted, "interrupted while sensor [" + section.name + "] was opened");
    }
    if (thread.hasFailedToOpen())
      throw base::Error(base::ExitCode::unreadable_input, section.file + ": sensor [" + section.name + "] (" +
                                                              section.driver +
                                                              ") cannot be opened: " + thread.metrics().problem);
  }
}

void LiveSource::close() {
  for (auto thread = parts_->threads.rbegin(); thread != parts_->threads.rend(); ++thread)
    parts_->has_left_behind = !thread->stop(kToStop) || parts_->has_left_behind;
  parts_->arrivals->close();
  if (auto* recorder = parts_->arrivals->recorder()) recorder->close();
  if (!parts_->has_left_behind) parts_->images.reset();
}

bool LiveSource::hasLeftBehind() const {
  return parts_->has_left_behind;
}

std::optional<LiveObservation> LiveSource::next(std::chrono::milliseconds patience) {
  return parts_->arrivals->next(patience);
}

void LiveSource::discardWaiting() {
  parts_->arrivals->discardWaiting();
}

std::vector<std::uint64_t> LiveSource::takeDropped() {
  return parts_->arrivals->takeDropped();
}

std::vector<std::string> LiveSource::takeNews() {
  std::vector<std::string> all;
  for (auto& thread : parts_->threads) {
    for (auto& sentence : thread.takeNews()) all.push_back(std::move(sentence));
  }
  const auto* recorder = parts_->arrivals->recorder();
  if (recorder && !parts_->has_reported_failure) {
    if (const auto failure = recorder->failure(); !failure.empty()) {
      all.push_back(failure + "; what was recorded before that can be read");
      parts_->has_reported_failure = true;
    }
  }
  return all;
}

std::vector<SensorMetrics> LiveSource::sensors() const {
  std::vector<SensorMetrics> all;
  for (const auto& thread : parts_->threads) all.push_back(thread.metrics());
  return all;
}

std::string LiveSource::sensorsText() const {
  std::string text;
  for (const auto& sensor : sensors()) {
    char rate[32];
    std::snprintf(rate, sizeof rate, "%.0f Hz", sensor.rate);
    const bool is_working = sensor.state == SensorMetrics::State::working;
    text += (text.empty() ? "" : ", ") + sensor.name + " " + (is_working ? rate : toString(sensor.state));
  }
  return text;
}

LiveCounts LiveSource::counts() const {
  return parts_->arrivals->counts();
}

source::SourceReport LiveSource::report() const {
  return parts_->arrivals->report();
}

const Recorder* LiveSource::recorder() const {
  return parts_->arrivals->recorder();
}

}  // namespace omnimapper::live
