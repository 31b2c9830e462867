#pragma once

#include <omnimapper/server/HttpMessage.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace omnimapper::server {

/// What a client may cost. Whoever needs more is refused or disconnected, and the others are served.
struct HttpLimits {
  std::size_t header_bytes = 16 * 1024, body_bytes = 64 * 1024;  ///< of one request; status 431 and 413
  int connections = 128;                                         ///< at once; status 503
  int event_streams = 32;                                        ///< among them; status 503
  std::size_t unsent_bytes = 1024 * 1024;                        ///< of events, for one client that reads slowly
  int request_s = 10;                                            ///< from its first byte to its last
  int idle_s = 60;                                               ///< between two requests of a connection
  int answer_s = 30;                                             ///< to take an answer
  double requests_per_s = 200;                                   ///< of all clients, on average; status 429
  double requests_at_once = 400;                                 ///< more than the average for a moment
  int waiting_answers = 16;                                      ///< that take long (HttpResponse::later); status 503
};

/// Whether that is a numeric address which only this machine reaches, such as 127.0.0.1 or ::1.
bool isLoopback(const std::string& address);

/// Serves HTTP/1.1 on a port of this machine, by one thread: the one that calls run(). Answers that take long are made
/// by another one, one after the other, so that they delay no other answer. A request that is too large, too slow,
/// damaged or has a compressed body never reaches the handler.
class HttpServer {
 public:
  using Handler = std::function<HttpResponse(const HttpRequest&)>;
  using Condition = std::function<bool(const HttpRequest&)>;

  /// Listens on a numeric address; port 0 takes a free one. Throws Error(out_of_range) for an address that is none, and
  /// Error(unreadable_input), naming address and remedy, if it cannot be listened on, for example because the port is
  /// in use. The handler must not throw; it is called by run(). So is `is_urgent`: requests for which it is true are
  /// not counted among those of HttpLimits::requests_per_s.
  HttpServer(const std::string& address, std::uint16_t port, const HttpLimits& limits, Handler handler,
             Condition is_urgent = {});
  ~HttpServer();

  std::uint16_t port() const;

  /// Serves until `stop` is true, which it asks ten times a second, together with `tick`.
  void run(const std::function<bool()>& stop, const std::function<void()>& tick = {});

  /// Sends an event to every open event stream: the text of its data, without line feeds. To be called by the thread of
  /// run() only: by the handler, or by `tick`.
  void send(const std::string& event);

 private:
  class Connections;
  std::unique_ptr<Connections> connections_;
};

}  // namespace omnimapper::server
