#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <string>

namespace omnimapper::server {

/// A client that sends any bytes.
class Client {
 public:
  explicit Client(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// False if the server has closed the connection.
  bool send(const std::string& bytes) {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  /// Says that nothing more comes.
  void finish() { ::shutdown(socket_, SHUT_WR); }
  /// Reads until the answer contains `text`, or the server closes the connection; all that was read since the last
  /// call.
  std::string readTo(const std::string& text) {
    std::string bytes;
    char piece[4096];
    while (bytes.find(text) == std::string::npos) {
      const auto size = ::recv(socket_, piece, sizeof piece, 0);
      if (size <= 0) break;
      bytes.append(piece, static_cast<std::size_t>(size));
    }
    return bytes;
  }
  /// All until the server closes the connection.
  std::string readAll() { return readTo(std::string(1, '\0') + "never"); }
  /// Whether the server has closed the connection; waits for it or for bytes.
  bool isClosed() {
    char byte = 0;
    return ::recv(socket_, &byte, 1, MSG_PEEK) <= 0;
  }

 private:
  int socket_;
};

}  // namespace omnimapper::server
