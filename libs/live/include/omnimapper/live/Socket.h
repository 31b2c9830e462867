#pragma once

#include <cstdint>
#include <string>

namespace omnimapper::live {

/// Owns a file descriptor, such as that of a socket.
class Descriptor {
 public:
  explicit Descriptor(int file = -1) : file_(file) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  explicit operator bool() const { return file_ >= 0; }
  int get() const { return file_; }
  void close();

 private:
  int file_;
};

/// Where a socket is bound: a numeric IPv4 address of this machine ("127.0.0.1", or "0.0.0.0" for all its addresses)
/// and a port; for port 0 the system chooses a free port.
struct SocketAddress {
  std::string ip = "127.0.0.1";
  std::uint16_t port = 0;
};
/// "127.0.0.1:7000".
std::string toString(const SocketAddress& address);

/// listenTcp() returns a socket that accepts TCP connections, bindUdp() a socket that receives UDP datagrams. These
/// sockets never block, and child processes do not inherit them. Both functions throw Error(out_of_range) for an
/// address that is not numeric, and Error(unreadable_input) if the socket cannot be bound to the address, for example
/// because the port is in use; the message names address, reason and remedy.
Descriptor listenTcp(const SocketAddress& address);
Descriptor bindUdp(const SocketAddress& address);

/// The port to which the socket is bound, also if the system chose it.
std::uint16_t boundPort(const Descriptor& socket);

}  // namespace omnimapper::live
