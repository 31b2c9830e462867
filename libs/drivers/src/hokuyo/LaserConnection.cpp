#include "hokuyo/LaserConnection.h"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace omnimapper::drivers {

namespace {

constexpr int kToConnect = 3000, kToSend = 500;  // [ms]

// Waits for these events; a signal does not end the wait.
bool isReady(const live::Descriptor& file, short events, int patience) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::milliseconds(patience);
  pollfd entry{file.get(), events, 0};
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    const int count = poll(&entry, 1, static_cast<int>(std::max<std::int64_t>(left, 0)));
    if (count >= 0 || errno != EINTR) return count > 0;
  }
}

// The error number if the connection fails, else 0.
int failureToConnect(const live::Descriptor& socket, const addrinfo& address) {
  if (connect(socket.get(), address.ai_addr, address.ai_addrlen) == 0) return 0;
  if (errno != EINPROGRESS) return errno;
  if (!isReady(socket, POLLOUT, kToConnect)) return ETIMEDOUT;
  int error = 0;
  socklen_t size = sizeof error;
  getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &error, &size);
  return error;
}

speed_t speedOf(int rate) {
  switch (rate) {
    case 19200:
      return B19200;
    case 115200:
      return B115200;
    default:
      throw std::runtime_error("serial ports do not support " + std::to_string(rate) + " baud here");
  }
}

}  // namespace

LaserConnection LaserConnection::toHost(const std::string& host, std::uint16_t port) {
  const std::string name = host + ":" + std::to_string(port);
  addrinfo hints{}, *found = nullptr;
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_STREAM;
  if (const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found))
    throw std::runtime_error("there is no host " + host + ": " + gai_strerror(error));
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owned(found, freeaddrinfo);
  live::Descriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int error = socket ? failureToConnect(socket, *found) : errno;
  if (error != 0) throw std::runtime_error("nobody answers at " + name + ": " + std::strerror(error));
  return LaserConnection(std::move(socket), false);
}

LaserConnection LaserConnection::toSerialPort(const std::string& path) {
  const std::string whole = path.rfind('/', 0) == 0 ? path : "/dev/" + path;
  live::Descriptor port(::open(whole.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  termios settings{};
  if (!port || tcgetattr(port.get(), &settings) != 0)
    throw std::runtime_error("cannot open the serial port " + whole + ": " + std::strerror(errno));
  cfmakeraw(&settings);
  settings.c_cflag |= CREAD | CLOCAL;
  tcflush(port.get(), TCIOFLUSH);
  if (tcsetattr(port.get(), TCSANOW, &settings) != 0)
    throw std::runtime_error("cannot set up the serial port " + whole + ": " + std::strerror(errno));
  return LaserConnection(std::move(port), true);
}

void LaserConnection::setBaudRate(int rate) {
  termios settings{};
  if (!is_serial_ || !isOpen() || tcgetattr(file_.get(), &settings) != 0) return;
  cfsetspeed(&settings, speedOf(rate));
  if (tcsetattr(file_.get(), TCSADRAIN, &settings) != 0)
    throw std::runtime_error("the serial port does not support " + std::to_string(rate) + " baud");
}

std::string LaserConnection::receive(int patience) {
  if (!isOpen() || !isReady(file_, POLLIN, patience)) return "";
  std::string bytes(16384, '\0');
  const auto size = read(file_.get(), bytes.data(), bytes.size());
  if (size == 0 || (size < 0 && errno != EAGAIN && errno != EINTR)) close();
  bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return bytes;
}

bool LaserConnection::send(std::string_view bytes) {
  while (isOpen() && !bytes.empty()) {
    const auto size = is_serial_ ? write(file_.get(), bytes.data(), bytes.size())
                                 : ::send(file_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (size > 0)
      bytes.remove_prefix(static_cast<std::size_t>(size));
    else if (errno != EINTR && (errno != EAGAIN || !isReady(file_, POLLOUT, kToSend)))
      close();
  }
  return isOpen();
}

}  // namespace omnimapper::drivers
