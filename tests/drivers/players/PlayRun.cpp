#include "PlayRun.h"

#include <omnimapper/base/Error.h>

#include <charconv>
#include <utility>

namespace omnimapper::players {

namespace {

/// The scans of a laser, and its address.
std::pair<PlayedLog::Scans, std::string> laserOf(const PlayedLog& log, const std::string& text) {
  const auto equals = text.find('=');
  if (equals != std::string::npos) {
    const auto found = log.lasers.find(text.substr(0, equals));
    if (found != log.lasers.end()) return {found->second, text.substr(equals + 1)};
  } else if (log.lasers.size() == 1) {
    return {log.lasers.begin()->second, text};
  }
  std::string labels;
  for (const auto& [label, scans] : log.lasers) labels += (labels.empty() ? "" : ", ") + label;
  throw base::Error(base::ExitCode::command_line,
                    "\"" + text +
                        "\" names no laser of the log: write LABEL=ADDRESS with the label of one of its lasers: " +
                        (labels.empty() ? "it has none" : labels));
}

std::unique_ptr<Link> linkAt(const std::string& address) {
  return address.find('/') == std::string::npos ? makeTcpLink(parseSocketAddress(address)) : makeTerminalLink(address);
}

}  // namespace

live::SocketAddress parseSocketAddress(const std::string& text) {
  const auto colon = text.rfind(':');
  std::uint16_t port = 0;
  const auto begin = text.data() + (colon == std::string::npos ? text.size() : colon + 1);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), port);
  if (error != std::errc() || end != text.data() + text.size())
    throw base::Error(base::ExitCode::command_line,
                      "\"" + text + "\" is no address: write IP:PORT, such as 127.0.0.1:10940");
  return {text.substr(0, colon), port};
}

PlayRun::PlayRun(PlayedLog log, PlayOptions options) : options_(std::move(options)) {
  for (const auto& each : options_.hokuyos) {
    auto [scans, address] = laserOf(log, each);
    hokuyos_.push_back(
        std::make_unique<HokuyoPlayer>(std::move(scans), linkAt(address), options_.pace, options_.hokuyo));
  }
  if (options_.odometry) odometry_ = std::make_unique<OdometryPlayer>(log.odometry, *options_.odometry);
  const int players = static_cast<int>(hokuyos_.size()) + (odometry_ ? 1 : 0);
  start_ = std::make_unique<CommonStart>(players, log.start(), options_.pace, options_.host_start);
}

PlayRun::~PlayRun() {
  stop();
  join();
}

void PlayRun::start(const Stop& stop) {
  stop_ = [this, stop] { return stopped_ || (stop && stop()); };
  for (const auto& hokuyo : hokuyos_)
    startThread([this, player = hokuyo.get()] {
      if (!player->waitForStart(*start_, stop_)) return;
      player->play(*start_->clock(), stop_);
      player->linger(options_.linger, stop_);
    });
  if (odometry_) startThread([this] { odometry_->play(*start_, stop_); });
}

void PlayRun::startThread(const std::function<void()>& play) {
  threads_.emplace_back([this, play] {
    try {
      play();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      stop();
    }
  });
}

std::optional<PlayClock> PlayRun::waitForStart() {
  while (!start_->clock() && !stop_()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return start_->clock();
}

void PlayRun::wait() {
  join();
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void PlayRun::join() {
  for (auto& thread : threads_) thread.join();
  threads_.clear();
}

std::vector<std::string> PlayRun::addresses() const {
  std::vector<std::string> all;
  for (const auto& hokuyo : hokuyos_) all.push_back(hokuyo->address());
  return all;
}

}  // namespace omnimapper::players
