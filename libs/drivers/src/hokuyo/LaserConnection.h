#pragma once

#include <omnimapper/live/Socket.h>

#include <string>
#include <string_view>

namespace omnimapper::drivers {

/// The open connection to a laser: TCP or a serial port. Unlike MRPT's, it neither ends the program by a signal nor
/// waits for ever if the laser has closed the connection.
class LaserConnection {
 public:
  /// Both throw std::runtime_error with a sentence that names the laser and the system's reason.
  /// `host` is a name or address; it is given 3 s to answer.
  static LaserConnection toHost(const std::string& host, std::uint16_t port);
  /// A path, or a name in /dev. 8 bits, no parity, raw.
  static LaserConnection toSerialPort(const std::string& path);

  /// Returns the bytes that have arrived; waits at most `patience` [ms] for the first one. Empty also if the laser has
  /// closed the connection.
  std::string receive(int patience);
  /// Sends all of it, or closes the connection and returns false.
  bool send(std::string_view bytes);
  /// Sets the rate of a serial port; throws std::runtime_error if the port does not support it. Does nothing with TCP.
  void setBaudRate(int rate);

  bool isOpen() const { return static_cast<bool>(file_); }
  bool isSerial() const { return is_serial_; }
  void close() { file_.close(); }

 private:
  LaserConnection(live::Descriptor file, bool is_serial) : file_(std::move(file)), is_serial_(is_serial) {}

  live::Descriptor file_;
  bool is_serial_;
};

}  // namespace omnimapper::drivers
