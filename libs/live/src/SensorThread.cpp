#include "SensorThread.h"

#include <mrpt/obs/CObservationComment.h>
#include <omnimapper/base/Exceptions.h>
#include <omnimapper/live/HostClock.h>
#include <omnimapper/live/SensorDriver.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <utility>

namespace omnimapper::live {

namespace {

using Clock = std::chrono::steady_clock;
using State = SensorMetrics::State;

constexpr auto kBetweenAttempts = std::chrono::milliseconds(500);  // often enough without a load for the device
constexpr auto kRateWindow = std::chrono::seconds(3);

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::string inSeconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", seconds);
  return text;
}

}  // namespace

struct SensorThread::Shared {
  Shared(SensorSection its, const LiveOptions& all, std::shared_ptr<Arrivals> where)
      : section(std::move(its)),
        options(all),
        arrivals(std::move(where)),
        clock(section.options, all.max_clock_offset) {
    metrics.name = section.name;
  }

  const SensorSection section;
  const LiveOptions options;
  const std::shared_ptr<Arrivals> arrivals;
  SensorClock clock;  // used only by the thread

  std::mutex mutex;
  std::condition_variable changed;
  bool stopping = false, was_open = false, failed_to_open = false, ended = false;
  SensorMetrics metrics;
  Clock::time_point last_arrival = Clock::now();
  std::uint64_t left_out_before = 0;  // by earlier drivers of this sensor
  std::uint64_t next_left_out_report = 1;
  std::deque<Clock::time_point> arrived;  // in the last seconds
  std::deque<double> gaps;                // [s] between the last arrivals
  std::vector<std::string> news;

  bool isStopping() {
    const std::lock_guard lock(mutex);
    return stopping;
  }
  // Returns early when the thread is stopped.
  void sleep(std::chrono::duration<double> time) {
    std::unique_lock lock(mutex);
    changed.wait_for(lock, time, [this] { return stopping; });
  }
  // [s] Silence is judged by the longest recent gap, because some sensors send seldom.
  double longestGap() const { return gaps.empty() ? 0 : *std::max_element(gaps.begin(), gaps.end()); }
  double reopensAfter() {
    const std::lock_guard lock(mutex);
    return std::max(options.reopen_after, 3 * longestGap());
  }
  void addNews(const std::string& sentence) { news.push_back("sensor [" + section.name + "] " + sentence); }

  std::string unreadKey(const std::string& key) const {
    return "has a key that its driver " + section.driver + " does not read: " + key;
  }

  void opened(const SensorDriver& driver) {
    const std::lock_guard lock(mutex);
    if (!was_open) {
      for (const auto& key : driver.unreadKeys()) addNews(unreadKey(key));
      metrics.state = State::working;
      last_arrival = Clock::now();
    }
    metrics.sends_on_request = driver.sendsOnRequest();
    was_open = true;
    changed.notify_all();
  }
  void arrivedNow(std::size_t count) {
    const std::lock_guard lock(mutex);
    const auto now = Clock::now();
    const bool was_working = metrics.state == State::working && metrics.observations > 0;
    if (metrics.state == State::lost || metrics.state == State::silent) {
      addNews("is back after " + inSeconds(std::chrono::duration<double>(now - last_arrival).count()));
      ++metrics.reopened;
    }
    metrics.state = State::working;
    metrics.observations += count;
    constexpr std::size_t kGaps = 10;
    if (was_working) gaps.push_back(std::chrono::duration<double>(now - last_arrival).count());
    if (gaps.size() > kGaps) gaps.pop_front();
    last_arrival = now;
    arrived.insert(arrived.end(), count, now);
    while (now - arrived.front() > kRateWindow) arrived.pop_front();
    if (clock.jumps() > metrics.clock_jumps) {
      char text[160];
      std::snprintf(text, sizeof text, "has a clock that is %.3f s from the host's; its stamps are corrected by that",
                    clock.offset());
      addNews(text);
    }
    metrics.clock_jumps = clock.jumps();
    metrics.clock_offset = clock.offset();
  }
  // Reports rejected data the first time, and each time that their number has doubled.
  void leftOut(const SensorDriver& driver) {
    const std::lock_guard lock(mutex);
    metrics.left_out = left_out_before + driver.leftOut();
    if (metrics.left_out < next_left_out_report) return;
    addNews("sent invalid data, which was discarded: " + driver.leftOutByReason());
    next_left_out_report = 2 * metrics.left_out;
  }
  // Handles an exception of the driver. The first failure of a sensor that was never open ends the thread.
  void failed(const std::string& reason) {
    const std::lock_guard lock(mutex);
    if (!was_open) {
      failed_to_open = true;
      metrics.problem = reason;
    } else if (metrics.state != State::lost) {
      addNews("is lost: " + reason + "; it is opened again as soon as it answers");
      metrics.problem = reason;
      metrics.losses += metrics.state != State::silent;
    }
    metrics.state = State::lost;
    changed.notify_all();
  }
};

SensorThread::SensorThread(SensorSection section, const LiveOptions& options, std::shared_ptr<Arrivals> arrivals)
    : shared_(std::make_shared<Shared>(std::move(section), options, std::move(arrivals))) {}

void SensorThread::start() {
  thread_ = std::thread([shared = shared_] { run(shared); });
}

void SensorThread::run(const std::shared_ptr<Shared>& shared) {
  // These signals are blocked, because MRPT's sockets write to devices that have closed the connection, which would end
  // the program, and a driver that is interrupted takes that for a failure of its device.
  sigset_t blocked;
  sigemptyset(&blocked);
  for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGHUP}) sigaddset(&blocked, signal);
  pthread_sigmask(SIG_BLOCK, &blocked, nullptr);
  while (!shared->isStopping()) {
    try {
      readDriver(*shared);
    } catch (const std::exception& error) {
      shared->failed(base::sentenceOf(error));
    } catch (...) {
      shared->failed("its driver has thrown an object that is no std::exception");
    }
    {
      const std::lock_guard lock(shared->mutex);
      if (shared->failed_to_open) break;
      shared->left_out_before = shared->metrics.left_out;
    }
    shared->sleep(kBetweenAttempts);
  }
  const std::lock_guard lock(shared->mutex);
  if (shared->metrics.state == State::working || shared->metrics.state == State::opening)
    shared->metrics.state = State::stopped;
  shared->ended = true;
  shared->changed.notify_all();
}

// If the driver cannot be opened, the keys that it does not read are named, because they may be the reason.
void SensorThread::openDriver(Shared& shared, SensorDriver& driver) {
  try {
    driver.open();
  } catch (const std::exception& error) {
    std::string reason = base::sentenceOf(error);
    for (const auto& key : driver.unreadKeys()) reason += "; it " + shared.unreadKey(key);
    throw std::runtime_error(reason);
  }
  shared.opened(driver);
}

// Reads until the sensor fails, falls silent, or is stopped.
void SensorThread::readDriver(Shared& shared) {
  const auto driver = makeDriver(shared.section);
  openDriver(shared, *driver);
  const double rate = driver->rate();
  constexpr double kMostOften = 500;  // [Hz]
  const std::chrono::duration<double> period(1 / (rate > 0 ? std::min(rate, kMostOften) : kMostOften));
  auto silent_since = Clock::now();
  while (!shared.isStopping()) {
    const auto begin = Clock::now();
    const auto objects = driver->read();
    const auto arrival = hostNow();
    shared.leftOut(*driver);
    std::size_t count = 0;
    for (const auto& object : objects) {
      const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object);
      // Comments are no observations, as for readers of logs.
      if (observation && !std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(object)) {
        shared.arrivals->add(*observation, arrival, shared.clock);
        ++count;
      } else if (object) {
        shared.arrivals->addOther(object->GetRuntimeClass()->className);
      }
    }
    if (count > 0) {
      shared.arrivedNow(count);
      silent_since = Clock::now();
    } else if (driver->hasFailed()) {
      throw std::runtime_error("its driver reports that it failed");
    } else if (!driver->waitsForOthers() && secondsSince(silent_since) > shared.reopensAfter()) {
      throw std::runtime_error("it has sent nothing for " + inSeconds(secondsSince(silent_since)));
    }
    const auto spent = Clock::now() - begin;
    if (spent < period) shared.sleep(period - spent);
  }
}

bool SensorThread::waitUntilOpen(std::chrono::milliseconds patience) const {
  std::unique_lock lock(shared_->mutex);
  return shared_->changed.wait_for(lock, patience, [this] { return shared_->was_open || shared_->failed_to_open; });
}

bool SensorThread::hasFailedToOpen() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->failed_to_open;
}

bool SensorThread::stop(std::chrono::milliseconds patience) {
  if (!thread_.joinable()) return true;
  bool has_ended = false;
  {
    std::unique_lock lock(shared_->mutex);
    shared_->stopping = true;
    shared_->changed.notify_all();
    has_ended = shared_->changed.wait_for(lock, patience, [this] { return shared_->ended; });
  }
  has_ended ? thread_.join() : thread_.detach();
  return has_ended;
}

std::vector<std::string> SensorThread::takeNews() {
  const std::lock_guard lock(shared_->mutex);
  const double silence = secondsSince(shared_->last_arrival);
  const double patience = std::max(shared_->options.silent_after, 2 * shared_->longestGap());
  const bool may_be_silent = shared_->metrics.sends_on_request || shared_->ended;
  if (shared_->metrics.state == State::working && silence > patience && !may_be_silent) {
    shared_->metrics.state = State::silent;
    ++shared_->metrics.losses;
    shared_->addNews("is silent: it has sent nothing for " + inSeconds(silence));
  }
  return std::exchange(shared_->news, {});
}

SensorMetrics SensorThread::metrics() const {
  const std::lock_guard lock(shared_->mutex);
  SensorMetrics metrics = shared_->metrics;
  const auto since = Clock::now() - kRateWindow;
  const auto newest =
      std::count_if(shared_->arrived.begin(), shared_->arrived.end(), [&](const auto& when) { return when > since; });
  metrics.rate = static_cast<double>(newest) / std::chrono::duration<double>(kRateWindow).count();
  return metrics;
}

}  // namespace omnimapper::live
