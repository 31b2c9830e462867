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
  /// What the host sent; waits at most so long [s] for it. Takes a host that connects.
  std::string receive(double wait);
  /// Queues bytes for the host and sends what it takes. Returns false, and sends nothing of them, if nobody is
  /// connected, or the host has left 256 KiB unread.
  bool send(std::string_view bytes);
  /// What a driver of MRPT is told, such as "127.0.0.1:10940" or the path of the terminal.
  virtual std::string address() const = 0;
  /// Ends the connection; nobody can connect before restore().
  virtual void cut() = 0;
  virtual void restore() = 0;

 protected:
  /// The open connection; -1 if there is none.
  virtual int connection() = 0;
  /// What becomes readable when a host connects; -1 if nothing does.
  virtual int listener() = 0;
  virtual void acceptHost() = 0;
  /// The host hung up.
  virtual void lose() = 0;
  void dropQueue() { queue_.clear(); }

 private:
  void flush();
  std::string queue_;
};

/// Listens at that address; the last host that connects is the one. Throws as live::listenTcp().
std::unique_ptr<Link> makeTcpLink(const live::SocketAddress& address);

/// A pseudo-terminal, to which a symbolic link of that path points; it is made, and removed at the end. Throws
/// Error(unwritable_output) if it cannot be made.
std::unique_ptr<Link> makeTerminalLink(const std::string& path);

}  // namespace omnimapper::players
