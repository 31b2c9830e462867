#include "HokuyoPlayer.h"

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/live/HostClock.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <thread>

namespace omnimapper::players {

namespace {

constexpr double kLongestWait = 0.02;  // [s] longest time until a stop is noticed
constexpr double kSettled = 0.2;       // [s]
constexpr int kPieces = 8;

HokuyoModel modelOf(const HokuyoPlayer::Scans& scans, double pace) {
  if (scans.size() < 2)
    throw base::Error(base::ExitCode::unreadable_input, "The log has fewer than two scans of this laser.");
  const double seconds = base::secondsBetween(scans.front()->timestamp, scans.back()->timestamp);
  return HokuyoModel::fitting(*scans.front(), pace * static_cast<double>(scans.size() - 1) / std::max(seconds, 1e-3));
}

}  // namespace

HokuyoPlayer::HokuyoPlayer(Scans scans, std::unique_ptr<Link> link, double pace, HokuyoPlayerOptions options)
    : scans_(std::move(scans)),
      link_(std::move(link)),
      options_(std::move(options)),
      device_(modelOf(scans_, pace)),
      started_(live::hostNow()) {}

std::uint32_t HokuyoPlayer::deviceTime(base::Stamp host) const {
  const double ms = 1000 * base::secondsBetween(started_, host) * (1 + options_.clock_drift);
  return static_cast<std::uint32_t>(options_.first_time_ms + std::llround(ms)) & 0xffffffU;
}

void HokuyoPlayer::serve(double wait) {
  const auto now = live::hostNow();
  if (base::isValid(cut_until_) && now >= cut_until_) {
    link_->restore();
    cut_until_ = base::Stamp();
  }
  const std::string answers = device_.receive(link_->receive(wait), deviceTime(live::hostNow()));
  if (answers.empty() || now < silent_until_) return;
  if (options_.answer_delay > 0) std::this_thread::sleep_for(std::chrono::duration<double>(options_.answer_delay));
  link_->send(answers);
}

bool HokuyoPlayer::serveUntil(base::Stamp host, const Stop& stop) {
  for (;;) {
    const double left = base::secondsBetween(live::hostNow(), host);
    if (stop()) return false;
    serve(std::clamp(left - 0.001, 0.0, kLongestWait));
    if (left <= 0) return true;
  }
}

bool HokuyoPlayer::waitForHost(const Stop& stop) {
  auto wanted_since = live::hostNow();
  while (base::secondsBetween(wanted_since, live::hostNow()) < kSettled) {
    if (stop()) return false;
    serve(kLongestWait);
    if (!device_.isMeasuring()) wanted_since = live::hostNow();
  }
  return true;
}

bool HokuyoPlayer::waitForStart(CommonStart& start, const Stop& stop) {
  if (!start.clock() && !waitForHost(stop)) return false;
  start.ready();
  while (!start.clock()) {
    if (stop()) return false;
    serve(kLongestWait);
  }
  return true;
}

void HokuyoPlayer::play(const PlayClock& clock, const Stop& stop) {
  for (std::size_t index = 0; index < scans_.size(); ++index) {
    if (!serveUntil(clock.hostTime(scans_[index]->timestamp), stop)) return;
    playScan(index, clock, stop);
  }
}

void HokuyoPlayer::linger(double seconds, const Stop& stop) {
  serveUntil(live::hostNow() + base::durationFromSeconds(seconds), stop);
}

void HokuyoPlayer::playScan(std::size_t index, const PlayClock& clock, const Stop& stop) {
  const auto& scan = *scans_[index];
  const auto fault =
      std::find_if(options_.faults.begin(), options_.faults.end(), [&](const Fault& each) { return each.at == index; });
  const auto* now_wrong = fault == options_.faults.end() ? nullptr : &*fault;
  const auto seconds = base::durationFromSeconds(now_wrong ? now_wrong->seconds : 0);
  PlayedScan played{index, scan.timestamp, clock.hostTime(scan.timestamp), live::hostNow(), 0, false};
  if (now_wrong && now_wrong->kind == Fault::Kind::silence) silent_until_ = played.sent + seconds;
  if (now_wrong && now_wrong->kind == Fault::Kind::hangup) {
    link_->cut();
    device_.receive("QT\n", 0);  // the request for scans ends with the connection
    cut_until_ = played.sent + seconds;
  }
  played.device_ms = deviceTime(played.host);
  const std::string message = device_.measured(hokuyoScan(scan, device_.model()), played.device_ms);
  if (!message.empty() && played.sent >= silent_until_) played.was_sent = sendWith(now_wrong, message, stop);
  played_.push_back(played);
}

bool HokuyoPlayer::sendWith(const Fault* fault, const std::string& message, const Stop& stop) {
  if (!fault || fault->kind >= Fault::Kind::silence) return link_->send(message);
  if (fault->kind != Fault::Kind::slow) {
    const bool was_sent = link_->send(damaged(message, fault->kind, fault->at));
    return was_sent && fault->kind != Fault::Kind::half;
  }
  const auto begin = live::hostNow();
  const std::size_t piece = message.size() / kPieces + 1;
  for (std::size_t i = 0; i * piece < message.size(); ++i) {
    if (!serveUntil(begin + base::durationFromSeconds(fault->seconds * static_cast<double>(i) / kPieces), stop))
      return false;
    if (!link_->send(message.substr(i * piece, piece))) return false;
  }
  return true;
}

void HokuyoPlayer::writeRecord(const std::string& path) const {
  std::string text = "# index log_s due_s sent_s device_ms was_sent\n";
  for (const auto& scan : played_)
    text += std::to_string(scan.index) + " " + base::formatUnix(scan.log) + " " + base::formatUnix(scan.host) + " " +
            base::formatUnix(scan.sent) + " " + std::to_string(scan.device_ms) + (scan.was_sent ? " 1\n" : " 0\n");
  base::writeFile(path, [&](std::ostream& out) { out << text; });
}

}  // namespace omnimapper::players
