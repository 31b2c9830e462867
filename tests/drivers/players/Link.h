#pragma once

#include <omnimapper/live/Socket.h>

#include <memory>
#include <string>
#include <string_view>

namespace omnimapper::players {

/// The connection between a played device and one host: TCP or a pseudo-terminal.
class Link {
 public:
  virtual ~Link() = default;
  /// The bytes that the host sent; waits at most so long [s] for them. Accepts a host that connects.
  std::string receive(double wait);
  /// Queues bytes for the host and sends what it takes. Returns false, and sends nothing of them, if nobody is
  /// connected, or the host has left 256 KiB unread.
  bool send(std::string_view bytes);
  /// The address for a driver of MRPT, such as "127.0.0.1:10940" or the path of the terminal.
  virtual std::string address() const = 0;
  /// Ends the connection; nobody can connect before restore().
  virtual void cut() = 0;
  virtual void restore() = 0;

 protected:
  /// The open connection; -1 if there is none.
  virtual int connection() = 0;
  /// The file that becomes readable when a host connects; -1 if none does.
  virtual int listener() = 0;
  virtual void acceptHost() = 0;
  /// To be called when the host has closed the connection.
  virtual void lose() = 0;
  void dropQueue() { queue_.clear(); }

 private:
  void flush();
  std::string queue_;
};

/// Listens at that address; a host that connects replaces the one before. Throws as live::listenTcp().
std::unique_ptr<Link> makeTcpLink(const live::SocketAddress& address);

/// A pseudo-terminal with a symbolic link to it at that path, which is made here and removed at the end. Throws
/// Error(unwritable_output) if it cannot be made.
std::unique_ptr<Link> makeTerminalLink(const std::string& path);

}  // namespace omnimapper::players
