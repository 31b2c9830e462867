#include "run/LogFeed.h"

#include <omnimapper/source/openLogs.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

namespace omnimapper::mapper {

namespace {

// Sleeps so that log time passes `speed` times as fast as real time.
class Pace {
 public:
  explicit Pace(double speed) : speed_(speed) {}
  // Returns early if `stop` returns true.
  void waitFor(base::Stamp stamp, const std::function<bool()>& stop) {
    if (speed_ <= 0 || !base::isValid(stamp)) return;
    if (!first_) first_ = stamp;
    const double due = base::secondsBetween(*first_, stamp) / speed_;
    for (double ahead; (ahead = due - watch_.seconds()) > 0 && !stop();) {
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(ahead, 0.1)));
    }
  }

 private:
  double speed_;
  std::optional<base::Stamp> first_;
  StopWatch watch_;
};

}  // namespace

std::string LogFeed::title() const {
  std::string title;
  for (const auto& log : logs_) {
    auto path = std::filesystem::path(log).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();  // a folder that ends with a slash
    title += (title.empty() ? "" : " + ") + path.stem().string();
  }
  return title;
}

std::string LogFeed::name() const {
  std::string name;
  for (const auto& log : logs_) name += (name.empty() ? "" : ", ") + log;
  return name;
}

void LogFeed::open(const Stop& stop) {
  log_.emplace(source::openLogs(logs_, options_, stop), stop);
}

bool LogFeed::feed(Engine& engine, SensorSamples& samples, base::Progress& progress, const Stop& stop) {
  Pace pace(speed_);
  const auto read = [&] {
    const auto timer = engine.measure(Stage::source);
    return log_->next();
  };
  while (!stop()) {
    const auto observation = read();
    // The log has ended, unless `stop` interrupted next().
    if (!observation) return log_->report().ending == source::SourceReport::Ending::open && stop();
    pace.waitFor(observation->timestamp, stop);
    if (stop()) return true;
    samples.add(observation);
    if (watch_) {
      const auto timer = engine.measure(Stage::source);
      try {
        watch_->add(observation);
      } catch (const std::exception& error) {
        engine.warn(std::string("the log is not checked any further: ") + error.what());
        watch_.reset();
      }
    }
    engine.add(observation);
    progress.report(log_->progress(), std::to_string(engine.view().map.key_frames.size()) + " key frames");
  }
  return true;
}

}  // namespace omnimapper::mapper
