#include "OdometryPlayer.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <omnimapper/live/HostClock.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstdio>

namespace omnimapper::players {

namespace {

constexpr double kBetweenAttempts = 0.2;  // [s]

live::Descriptor connectTo(const live::SocketAddress& address, int type) {
  sockaddr_in system{};
  system.sin_family = AF_INET;
  system.sin_port = htons(address.port);
  live::Descriptor socket(::socket(AF_INET, type | SOCK_CLOEXEC, 0));
  if (inet_pton(AF_INET, address.ip.c_str(), &system.sin_addr) != 1 ||
      connect(socket.get(), reinterpret_cast<const sockaddr*>(&system), sizeof system) != 0)
    socket.close();
  return socket;
}

}  // namespace

std::string odometryLine(const OdometryReading& reading, base::Stamp host, double pace) {
  const auto& pose = reading.odom_from_base;
  char text[256];
  std::snprintf(text, sizeof text, " %.17g %.17g %.17g", pose.x(), pose.y(), pose.phi());
  std::string line = base::formatUnix(host) + text;
  if (reading.velocity) {
    const auto& velocity = *reading.velocity;
    std::snprintf(text, sizeof text, " %.9g %.9g %.9g", velocity.vx * pace, velocity.vy * pace, velocity.omega * pace);
    line += text;
  }
  return line + "\n";
}

OdometryPlayer::OdometryPlayer(std::vector<OdometryReading> readings, OdometryPlayerOptions options)
    : readings_(std::move(readings)), options_(std::move(options)) {}

bool OdometryPlayer::tryToConnect() {
  socket_ = connectTo(options_.to, options_.udp ? SOCK_DGRAM : SOCK_STREAM);
  return static_cast<bool>(socket_);
}

bool OdometryPlayer::connect(const Stop& stop) {
  while (!tryToConnect())
    if (!waitUntil(live::hostNow() + base::durationFromSeconds(kBetweenAttempts), stop)) return false;
  return true;
}

void OdometryPlayer::play(CommonStart& start, const Stop& stop) {
  if (!connect(stop)) return;
  start.ready();
  while (!start.clock())
    if (!waitUntil(live::hostNow() + base::durationFromSeconds(0.01), stop)) return;
  const auto clock = *start.clock();
  auto away_until = clock.hostStart();
  for (std::size_t i = 0; i < readings_.size(); ++i) {
    const auto host = clock.hostTime(readings_[i].log);
    if (!waitUntil(host, stop)) return;
    const auto* fault = faultAt(i);
    if (fault && fault->seconds > 0) away_until = host + base::durationFromSeconds(fault->seconds);
    if (fault && fault->kind == Fault::Kind::hangup) socket_.close();
    if (host < away_until || (!socket_ && !tryToConnect())) continue;
    const std::string line = odometryLine(readings_[i], host, start.pace());
    if (send(fault ? damaged(line, fault->kind, i) : line)) ++sent_;
  }
}

const Fault* OdometryPlayer::faultAt(std::size_t number) const {
  const auto found =
      std::find_if(options_.faults.begin(), options_.faults.end(), [&](const Fault& one) { return one.at == number; });
  return found == options_.faults.end() ? nullptr : &*found;
}

bool OdometryPlayer::send(const std::string& line) {
  const auto size = ::send(socket_.get(), line.data(), line.size(), MSG_NOSIGNAL);
  if (size == static_cast<ssize_t>(line.size())) return true;
  if (!options_.udp) socket_.close();  // half a line was sent, or nobody is connected
  return false;
}

}  // namespace omnimapper::players
