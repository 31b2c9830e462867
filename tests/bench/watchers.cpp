// bench-watchers: what it costs that plugins may watch observations of which no key frame is made.
//
// Maps a simulated drive with laser and odometry three times over: as it is, with one plugin that watches every
// observation and does nothing, and with ten. Prints the time of each and the time of one watched observation. The
// drive does not matter: the cost is that of finding the watchers and of interpolating the pose.
#include <omnimapper/mapper/Features.h>
#include <omnimapper/plugin/WatchesObservations.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace {

using namespace omnimapper;

class Watcher : public mapper::MeasurementPlugin, public mapper::WatchesObservations {
 public:
  explicit Watcher(std::size_t& seen) : seen_(seen) {}
  bool wants(const mrpt::obs::CObservation&) const override { return false; }
  mapper::Batch measure(const map::KeyFrame&, const mapper::Observed&, const mapper::View&) override { return {}; }
  bool watches(const mrpt::obs::CObservation&) const override { return true; }
  mapper::WatchResult watch(const mapper::Watched&, const mapper::View&) override {
    ++seen_;
    return {};
  }

 private:
  std::size_t& seen_;
};

double secondsOf(const std::vector<mrpt::obs::CObservation::Ptr>& log, int watchers, std::size_t& seen) {
  const auto engine = testing::makeEngine(testing::kLaserIni);
  mapper::PluginChange change;
  for (int i = 0; i < watchers; ++i)
    change.added.measurement.push_back({"watcher_" + std::to_string(i), std::make_unique<Watcher>(seen)});
  if (watchers > 0) engine->changePlugins(std::move(change));
  const auto begin = std::chrono::steady_clock::now();
  testing::run(*engine, log);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

int main() {
  testing::SimulatedLogOptions options;
  options.laps = 3;
  const auto log = testing::SimulatedLog(options).observations();
  constexpr int kRuns = 5;
  std::printf("%zu observations, median of %d runs\nwatchers  seconds  microseconds per watched observation\n",
              log.size(), kRuns);
  double without = 0;
  for (const int watchers : {0, 1, 10}) {
    std::vector<double> seconds;
    std::size_t seen = 0;
    for (int run = 0; run < kRuns; ++run) {
      seen = 0;
      seconds.push_back(secondsOf(log, watchers, seen));
    }
    std::nth_element(seconds.begin(), seconds.begin() + kRuns / 2, seconds.end());
    const double median = seconds[kRuns / 2];
    if (watchers == 0) without = median;
    std::printf("%8d  %7.3f  %s\n", watchers, median,
                seen == 0 ? "-" : std::to_string(1e6 * (median - without) / static_cast<double>(seen)).c_str());
  }
  return 0;
}
