#include "Http.h"

#include <poll.h>
#include <sys/socket.h>

#include <cstdlib>
#include <sstream>

namespace live_page {

namespace {

constexpr std::size_t kLongest = 4096;  // bytes of a request
constexpr int kPatience = 200;          // ms

std::string decoded(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size()) {
      result += static_cast<char>(std::strtol(text.substr(i + 1, 2).c_str(), nullptr, 16));
      i += 2;
    } else {
      result += text[i] == '+' ? ' ' : text[i];
    }
  }
  return result;
}

HttpRequest parsed(const std::string& head) {
  HttpRequest request;
  std::istringstream in(head);
  std::string target;
  in >> request.method >> target;
  for (std::string line; std::getline(in, line);)
    if (line.rfind("Origin: ", 0) == 0) request.origin = line.substr(8);
  std::istringstream parts(target);
  std::getline(parts, request.path, '?');
  for (std::string name, value; std::getline(parts, name, '=') && std::getline(parts, value, '&');)
    request.values[decoded(name)] = decoded(value);
  return request;
}

}  // namespace

void answerClient(const omnimapper::live::Descriptor& listening,
                  const std::function<std::optional<std::string>(const HttpRequest&)>& pageFor) {
  const omnimapper::live::Descriptor client(::accept4(listening.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  pollfd state{client.get(), POLLIN, 0};
  std::string head;
  while (client && head.find("\r\n\r\n") == std::string::npos) {
    char bytes[kLongest];
    if (::poll(&state, 1, kPatience) <= 0) return;
    const auto count = ::recv(client.get(), bytes, sizeof bytes, 0);
    if (count <= 0 || head.size() > kLongest) return;
    head.append(bytes, static_cast<std::size_t>(count));
  }
  if (!client) return;
  const auto page = pageFor(parsed(head));
  const std::string answer = std::string("HTTP/1.1 ") + (page ? "200 OK" : "400 Bad Request") +
                             "\r\nContent-Type: text/html; charset=utf-8\r\nConnection: close\r\n\r\n" +
                             page.value_or("");
  state.events = POLLOUT;
  for (std::size_t sent = 0; sent < answer.size() && ::poll(&state, 1, kPatience) > 0;) {
    const auto count = ::send(client.get(), answer.data() + sent, answer.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) return;
    sent += static_cast<std::size_t>(count);
  }
}

}  // namespace live_page
