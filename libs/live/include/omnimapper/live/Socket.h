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

/// Where a socket is bound: a numeric IPv4 address of this machine ("127.0.0.1", or "0.0.0.0" for all of them), and a
/// port, of which 0 lets the system choose.
struct SocketAddress {
  std::string ip = "127.0.0.1";
  std::uint16_t port = 0;
};
/// "127.0.0.1:7000".
std::string toString(const SocketAddress& address);

/// A socket that takes TCP connections, or UDP datagrams. Neither ever blocks, and child processes do not inherit them.
/// Both throw Error(out_of_range) for an address that is not numeric, and Error(unreadable_input) if it cannot be
/// bound, for example because the port is in use; the message names address, reason and remedy.
Descriptor listenTcp(const SocketAddress& address);
Descriptor bindUdp(const SocketAddress& address);

/// The port to which the socket is bound, also if the system chose it.
std::uint16_t boundPort(const Descriptor& socket);

}  // namespace omnimapper::live
