#include <arpa/inet.h>
#include <netinet/in.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/live/Socket.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace omnimapper::live {

namespace {

sockaddr_in systemAddress(const SocketAddress& address) {
  sockaddr_in system{};
  system.sin_family = AF_INET;
  system.sin_port = htons(address.port);
  if (inet_pton(AF_INET, address.ip.c_str(), &system.sin_addr) != 1)
    throw base::Error(base::ExitCode::out_of_range,
                      "\"" + address.ip +
                          "\" is no IPv4 address: write numbers, such as 127.0.0.1 for this machine "
                          "alone or 0.0.0.0 for everybody who reaches it.");
  return system;
}

Descriptor bound(const SocketAddress& address, int type) {
  const auto system = systemAddress(address);
  Descriptor socket(::socket(AF_INET, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const auto fail = [&](const std::string& what) {
    const std::string reason = errno == EADDRINUSE ? "another program uses this port" : std::strerror(errno);
    throw base::Error(base::ExitCode::unreadable_input, "Cannot " + what + " " + toString(address) + ": " + reason +
                                                            ". Choose another port or address, or end that program.");
  };
  if (!socket) fail("make a socket for");
  // A program that has just ended leaves the port busy for a minute. This option takes the port anyway, but never from
  // a program that listens.
  const int on = 1;
  if (type == SOCK_STREAM) setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&system), sizeof system) != 0) fail("listen at");
  if (type == SOCK_STREAM && ::listen(socket.get(), 8) != 0) fail("listen at");
  return socket;
}

}  // namespace

Descriptor::Descriptor(Descriptor&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    close();
    file_ = std::exchange(other.file_, -1);
  }
  return *this;
}

void Descriptor::close() {
  if (file_ >= 0) ::close(std::exchange(file_, -1));
}

std::string toString(const SocketAddress& address) {
  return address.ip + ":" + std::to_string(address.port);
}

Descriptor listenTcp(const SocketAddress& address) {
  return bound(address, SOCK_STREAM);
}

Descriptor bindUdp(const SocketAddress& address) {
  return bound(address, SOCK_DGRAM);
}

std::uint16_t boundPort(const Descriptor& socket) {
  sockaddr_in system{};
  socklen_t size = sizeof system;
  if (getsockname(socket.get(), reinterpret_cast<sockaddr*>(&system), &size) != 0) return 0;
  return ntohs(system.sin_port);
}

}  // namespace omnimapper::live
