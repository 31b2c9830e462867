#include <omnimapper/plugin/StageTimes.h>

namespace omnimapper::mapper {

namespace {

std::string nameOf(Stage stage, const std::string& section) {
  switch (stage) {
    case Stage::source:
      return "source";
    case Stage::perception_wait:
      return "perception wait";
    case Stage::job_wait:
      return "job wait";
    case Stage::plugin:
      return "plugin " + section;
    case Stage::solve:
      return "solve";
    case Stage::output:
      return "output " + section;
    case Stage::engine:
      break;
  }
  return "engine";
}

}  // namespace

StageTimes::Timer::Timer(StageTimes& times, Stage stage, const std::string& section)
    : times_(times),
      total_(times.totals_[nameOf(stage, section)]),
      of_stage_(times.seconds_[static_cast<std::size_t>(stage)]),
      outer_(times.running_.timer) {
  if (outer_) outer_->before_ += outer_->watch_.seconds();
  times_.running_.timer = this;
  watch_ = {};
}

StageTimes::Timer::~Timer() {
  const double seconds = before_ + watch_.seconds();
  total_.seconds += seconds;
  ++total_.calls;
  of_stage_ += seconds;
  times_.running_.timer = outer_;
  if (outer_) outer_->watch_ = {};
}

void StageTimes::add(Stage stage, const std::string& section, double seconds) {
  Total& total = totals_[nameOf(stage, section)];
  total.seconds += seconds;
  ++total.calls;
  seconds_[static_cast<std::size_t>(stage)] += seconds;
}

StageTimes::Mark StageTimes::mark() const {
  return {
      {}, seconds(Stage::plugin), seconds(Stage::solve), seconds(Stage::perception_wait) + seconds(Stage::job_wait)};
}

void StageTimes::addKeyFrameSince(const Mark& begin) {
  const Mark now = mark();
  const double plugin = now.plugin - begin.plugin, solve = now.solve - begin.solve, wait = now.wait - begin.wait;
  addKeyFrame({1e3 * plugin, 1e3 * solve, 1e3 * (begin.watch.seconds() - plugin - solve - wait)});
}

}  // namespace omnimapper::mapper
