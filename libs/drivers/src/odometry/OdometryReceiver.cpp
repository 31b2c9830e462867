#include "odometry/OdometryReceiver.h"

#include <netinet/in.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/live/HostClock.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

namespace omnimapper::drivers {

namespace {

// Limits of one call of receive(), which would not return otherwise if a sender never paused.
constexpr std::size_t kMostBytes = 256 * 1024;  // the longest lines of a second at the default rate
constexpr int kMostDatagrams = 4096;            // a limit of bytes does not count empty datagrams
constexpr int kMostAccepted = 16;               // twice the queue of connections that live::listenTcp() asks for
constexpr std::size_t kMostQuoted = 80;         // bytes of a line
constexpr auto kSilence = std::chrono::seconds(1);

void countFault(LineFault fault, std::string_view line, OdometryLineCounts& counts) {
  if (counts.first_invalid.empty())
    counts.first_invalid = base::printable(line.substr(0, kMostQuoted)) + (line.size() > kMostQuoted ? "..." : "");
  if (fault == LineFault::malformed) ++counts.malformed;
  if (fault == LineFault::not_finite) ++counts.not_finite;
  if (fault == LineFault::too_large) ++counts.too_large;
}

}  // namespace

COdometryLines::Receiver::Receiver(const OdometryLinesOptions& options)
    : options_(options), bytes_(65536), allowance_(options.max_rate), allowed_(Monotonic::now()) {
  const live::SocketAddress address{options.bind, static_cast<std::uint16_t>(options.port)};
  socket_ = options.protocol == OdometryLinesOptions::Protocol::tcp ? live::listenTcp(address) : live::bindUdp(address);
}

void COdometryLines::Receiver::receive(OdometryLineCounts& counts, const Take& take) {
  if (options_.protocol == OdometryLinesOptions::Protocol::udp) {
    readDatagrams(counts, take);
  } else {
    readClient(counts, take);  // lines of the client before are taken, too
    takeUnstamped(counts, take);
    acceptClients(counts);
    readClient(counts, take);
  }
  takeUnstamped(counts, take);
}

void COdometryLines::Receiver::acceptClients(OdometryLineCounts& counts) {
  for (int i = 0; i < kMostAccepted; ++i) {
    live::Descriptor next(accept4(socket_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!next) return;
    client_ = std::move(next);
    beginClient(counts);
  }
}

void COdometryLines::Receiver::beginClient(OdometryLineCounts& counts) {
  if (line_.isInLine()) ++counts.cut_off;
  line_.clear();
  newest_ = base::Stamp();
  ++counts.clients;
}

void COdometryLines::Receiver::readClient(OdometryLineCounts& counts, const Take& take) {
  for (std::size_t read = 0; client_ && read < kMostBytes;) {
    const auto size = recv(client_.get(), bytes_.data(), bytes_.size(), 0);
    if (size > 0) {
      read += static_cast<std::size_t>(size);
      addTo(line_, {bytes_.data(), static_cast<std::size_t>(size)}, counts, take);
    } else if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) {
      return;
    } else {
      if (line_.isInLine()) ++counts.cut_off;
      line_.clear();
      client_.close();
    }
  }
}

void COdometryLines::Receiver::readDatagrams(OdometryLineCounts& counts, const Take& take) {
  std::size_t read = 0;
  for (int i = 0; i < kMostDatagrams && read < kMostBytes; ++i) {
    sockaddr_in from{};
    socklen_t from_size = sizeof from;
    const auto size =
        recvfrom(socket_.get(), bytes_.data(), bytes_.size(), 0, reinterpret_cast<sockaddr*>(&from), &from_size);
    if (size < 0) return;
    read += static_cast<std::size_t>(size);
    if (!isOfCurrentSender(std::uint64_t{from.sin_addr.s_addr} << 16 | from.sin_port, counts)) continue;
    LineBuffer datagram;
    if (addTo(datagram, {bytes_.data(), static_cast<std::size_t>(size)}, counts, take).isInLine())
      addTo(datagram, "\n", counts, take);
  }
}

bool COdometryLines::Receiver::isOfCurrentSender(std::uint64_t sender, OdometryLineCounts& counts) {
  const auto now = Monotonic::now();
  if (sender != sender_) {
    if (sender_ != 0 && now - heard_ < kSilence) return ++counts.other_sender, false;
    sender_ = sender;
    beginClient(counts);
  }
  heard_ = now;
  return true;
}

LineBuffer& COdometryLines::Receiver::addTo(LineBuffer& buffer, std::string_view bytes, OdometryLineCounts& counts,
                                            const Take& take) {
  buffer.add(
      bytes, [&](std::string_view line) { takeLine(line, counts, take); }, [&] { ++counts.too_long; });
  return buffer;
}

// As many lines as max_rate allows in a second may come at once.
bool COdometryLines::Receiver::isWithinRate() {
  const auto now = Monotonic::now();
  const double passed = std::chrono::duration<double>(now - allowed_).count();
  allowed_ = now;
  allowance_ = std::min(allowance_ + passed * options_.max_rate, static_cast<double>(options_.max_rate));
  if (allowance_ < 1) return false;
  allowance_ -= 1;
  return true;
}

void COdometryLines::Receiver::takeLine(std::string_view line, OdometryLineCounts& counts, const Take& take) {
  if (line.empty() || line.front() == '#') return;
  if (!isWithinRate()) return void(++counts.too_many);
  const auto parsed = parseOdometryLine(line);
  if (parsed.fault) return countFault(*parsed.fault, line, counts);
  const base::Stamp arrival = live::hostNow();
  if (!parsed.stamp) {
    if (unstamped_) ++counts.superseded;
    unstamped_.emplace(parsed, arrival);
    return;
  }
  takeUnstamped(counts, take);
  if (std::abs(base::secondsBetween(arrival, *parsed.stamp)) > options_.max_clock_offset)
    return void(++counts.wrong_clock);
  takeOdometry(parsed, *parsed.stamp, counts, take);
}

void COdometryLines::Receiver::takeUnstamped(OdometryLineCounts& counts, const Take& take) {
  if (!unstamped_) return;
  takeOdometry(unstamped_->first, unstamped_->second, counts, take);
  unstamped_.reset();
}

void COdometryLines::Receiver::takeOdometry(const OdometryLine& line, base::Stamp stamp, OdometryLineCounts& counts,
                                            const Take& take) {
  if (base::isValid(newest_) && stamp <= newest_) return void(++counts.not_newer);
  newest_ = stamp;
  ++counts.taken;
  auto odometry = std::make_shared<mrpt::obs::CObservationOdometry>(line.odometry);
  odometry->timestamp = stamp;
  take(odometry);
}

}  // namespace omnimapper::drivers
