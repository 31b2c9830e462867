#include <omnimapper/base/Error.h>
#include <omnimapper/server/HttpServer.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <chrono>
#include <utility>
#include <vector>

#include "HttpConnection.h"
#include "RequestRate.h"

namespace omnimapper::server {

namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

tcp::endpoint endpointOf(const std::string& address, std::uint16_t port) {
  boost::system::error_code error;
  const auto ip = asio::ip::make_address(address, error);
  if (error)
    throw base::Error(base::ExitCode::out_of_range,
                      "'" + address + "' is no numeric address of this machine, such as 127.0.0.1");
  return {ip, port};
}

tcp::acceptor listen(asio::io_context& context, const tcp::endpoint& endpoint) {
  try {
    return tcp::acceptor(context, endpoint, true);
  } catch (const boost::system::system_error& error) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "cannot listen on " + endpoint.address().to_string() + ", port " +
                          std::to_string(endpoint.port()) + ": " + error.code().message() +
                          "; end the program that uses the port, or choose another one");
  }
}

constexpr auto kTick = std::chrono::milliseconds(100);
constexpr int kTicksOfSilence = 150;  // an event stream without events gets a comment, so that proxies keep it

}  // namespace

bool isLoopback(const std::string& address) {
  boost::system::error_code error;
  const auto ip = asio::ip::make_address(address, error);
  return !error && ip.is_loopback();
}

class HttpServer::Connections : public HttpHost {
 public:
  Connections(const tcp::endpoint& endpoint, const HttpLimits& limits, Handler handler, Condition is_urgent)
      : limits_(limits),
        handler_(std::move(handler)),
        is_urgent_(std::move(is_urgent)),
        acceptor_(listen(context_, endpoint)),
        timer_(context_),
        rate_(limits_) {}

  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
  const HttpLimits& limits() const override { return limits_; }

  HttpResponse answer(const HttpRequest& request) override {
    const bool is_urgent = is_urgent_ && is_urgent_(request);
    if (!is_urgent && !rate_.take()) return refusal(429, "There are too many requests; wait a second.");
    return handler_(request);
  }

  bool answerLater(std::function<HttpResponse()> make, std::function<void(const HttpResponse&)> done) override {
    if (waiting_answers_ >= limits_.waiting_answers) return false;
    ++waiting_answers_;
    // The thread of run() alone calls and destroys `done`, which keeps a connection.
    asio::post(worker_, [this, make = std::move(make), done = std::move(done)]() mutable {
      asio::post(context_, [this, done = std::move(done), made = make()] {
        --waiting_answers_;
        done(made);
      });
    });
    return true;
  }

  bool addStream(const std::shared_ptr<HttpConnection>& connection) override {
    forgetClosed();
    if (static_cast<int>(streams_.size()) >= limits_.event_streams) return false;
    streams_.push_back(connection);
    return true;
  }

  void send(const std::string& bytes) {
    forgetClosed();
    silent_ticks_ = 0;
    for (const auto& connection : streams_) connection->stream(bytes);
  }

  void run(const std::function<bool()>& stop, const std::function<void()>& tick) {
    accept();
    waitForTick(stop, tick);
    context_.run();
    worker_.stop();  // what waits is dropped
    worker_.join();
    // What is still open is closed, so that no connection refers to this server any more.
    for (const auto& connection : open_)
      if (const auto alive = connection.lock()) alive->close();
    streams_.clear();
    context_.restart();
    context_.poll();
  }

 private:
  void accept() {
    acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error) serve(std::move(socket));
      accept();
    });
  }

  void serve(tcp::socket socket) {
    open_.erase(std::remove_if(open_.begin(), open_.end(), [](const auto& each) { return each.expired(); }),
                open_.end());
    const auto connection = std::make_shared<HttpConnection>(std::move(socket), *this);
    const bool is_one_too_many = static_cast<int>(open_.size()) >= limits_.connections;
    open_.push_back(connection);
    if (is_one_too_many) return connection->refuse(503, "There are too many connections; try again later.");
    connection->start();
  }

  void waitForTick(const std::function<bool()>& stop, const std::function<void()>& tick) {
    timer_.expires_after(kTick);
    timer_.async_wait([this, &stop, &tick](boost::system::error_code) {
      if (stop()) return context_.stop();
      if (tick) tick();
      if (++silent_ticks_ >= kTicksOfSilence) send(": nothing new\n\n");
      waitForTick(stop, tick);
    });
  }

  void forgetClosed() {
    streams_.erase(std::remove_if(streams_.begin(), streams_.end(), [](const auto& each) { return !each->isOpen(); }),
                   streams_.end());
  }

  HttpLimits limits_;
  Handler handler_;
  Condition is_urgent_;
  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer timer_;
  RequestRate rate_;
  asio::thread_pool worker_{1};
  int waiting_answers_ = 0;
  std::vector<std::weak_ptr<HttpConnection>> open_;
  std::vector<std::shared_ptr<HttpConnection>> streams_;
  int silent_ticks_ = 0;
};

HttpServer::HttpServer(const std::string& address, std::uint16_t port, const HttpLimits& limits, Handler handler,
                       Condition is_urgent)
    : connections_(
          std::make_unique<Connections>(endpointOf(address, port), limits, std::move(handler), std::move(is_urgent))) {}
HttpServer::~HttpServer() = default;

std::uint16_t HttpServer::port() const {
  return connections_->port();
}

void HttpServer::run(const std::function<bool()>& stop, const std::function<void()>& tick) {
  connections_->run(stop, tick);
}

void HttpServer::send(const std::string& event) {
  connections_->send("data: " + event + "\n\n");
}

}  // namespace omnimapper::server
