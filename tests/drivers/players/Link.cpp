#include "Link.h"

#include <fcntl.h>
#include <omnimapper/base/Error.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace omnimapper::players {

namespace {

constexpr std::size_t kLongestQueue = 256 * 1024;

class TcpLink : public Link {
 public:
  explicit TcpLink(const live::SocketAddress& address) : address_(address) {
    restore();
    address_.port = live::boundPort(listener_);
  }
  std::string address() const override { return live::toString(address_); }
  void cut() override {
    lose();
    listener_.close();
  }
  void restore() override {
    if (!listener_) listener_ = live::listenTcp(address_);
  }

 private:
  int connection() override { return host_.get(); }
  int listener() override { return listener_.get(); }
  void acceptHost() override {
    live::Descriptor next(accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!next) return;
    host_ = std::move(next);
    dropQueue();
  }
  void lose() override {
    host_.close();
    dropQueue();
  }

  live::SocketAddress address_;
  live::Descriptor listener_, host_;
};

class TerminalLink : public Link {
 public:
  explicit TerminalLink(std::string path) : path_(std::move(path)) { restore(); }
  ~TerminalLink() override { unlink(path_.c_str()); }
  std::string address() const override { return path_; }
  void cut() override {
    device_.close();
    host_side_.close();
    dropQueue();
    unlink(path_.c_str());
  }
  void restore() override {
    if (device_) return;
    device_ = live::Descriptor(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
    if (!device_ || grantpt(device_.get()) != 0 || unlockpt(device_.get()) != 0) fail();
    const std::string name = ptsname(device_.get());
    // It is kept open, so that the terminal keeps its settings while no host has it open.
    host_side_ = live::Descriptor(::open(name.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    termios raw{};
    if (!host_side_ || tcgetattr(host_side_.get(), &raw) != 0) fail();
    cfmakeraw(&raw);
    tcsetattr(host_side_.get(), TCSANOW, &raw);
    unlink(path_.c_str());
    if (symlink(name.c_str(), path_.c_str()) != 0) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw base::Error(base::ExitCode::unwritable_output,
                      "Cannot make a pseudo-terminal at " + path_ + ": " + std::strerror(errno));
  }
  int connection() override { return device_.get(); }
  int listener() override { return -1; }
  void acceptHost() override {}
  void lose() override { dropQueue(); }

  std::string path_;
  live::Descriptor device_, host_side_;
};

}  // namespace

std::string Link::receive(double wait) {
  pollfd files[2] = {{connection(), POLLIN, 0}, {listener(), POLLIN, 0}};
  if (!queue_.empty()) files[0].events |= POLLOUT;
  // The time is rounded up, so that a wait for less than a millisecond does not become a busy loop.
  if (poll(files, 2, static_cast<int>(wait * 1000) + (wait > 0 ? 1 : 0)) <= 0) return "";
  if (files[1].revents & POLLIN) acceptHost();
  flush();
  std::string bytes(4096, '\0');
  if (connection() < 0 || !(files[0].revents & (POLLIN | POLLHUP | POLLERR))) return "";
  const auto size = read(connection(), bytes.data(), bytes.size());
  if (size == 0 || (size < 0 && errno != EAGAIN && errno != EINTR)) lose();
  bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return bytes;
}

bool Link::send(std::string_view bytes) {
  if (connection() < 0 || queue_.size() > kLongestQueue) return false;
  queue_ += bytes;
  flush();
  return connection() >= 0;
}

void Link::flush() {
  while (!queue_.empty() && connection() >= 0) {
    // A plain write to a socket whose host is gone would end the program by a signal.
    auto size = ::send(connection(), queue_.data(), queue_.size(), MSG_NOSIGNAL);
    if (size < 0 && errno == ENOTSOCK) size = write(connection(), queue_.data(), queue_.size());
    if (size > 0) {
      queue_.erase(0, static_cast<std::size_t>(size));
    } else if (size < 0 && (errno == EAGAIN || errno == EINTR)) {
      return;
    } else {
      lose();
    }
  }
}

std::unique_ptr<Link> makeTcpLink(const live::SocketAddress& address) {
  return std::make_unique<TcpLink>(address);
}

std::unique_ptr<Link> makeTerminalLink(const std::string& path) {
  return std::make_unique<TerminalLink>(path);
}

}  // namespace omnimapper::players
