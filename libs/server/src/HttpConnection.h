#pragma once

#include <omnimapper/server/HttpServer.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/file_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace omnimapper::server {

class HttpConnection;

/// What a connection needs of the server that accepted it.
class HttpHost {
 public:
  virtual ~HttpHost() = default;
  virtual const HttpLimits& limits() const = 0;
  /// The handler's answer, or a refusal if there are too many requests.
  virtual HttpResponse answer(const HttpRequest& request) = 0;
  /// Has another thread make an answer that takes long, and `done` called with it by this thread; false if too many
  /// wait.
  virtual bool answerLater(std::function<HttpResponse()> make, std::function<void(const HttpResponse&)> done) = 0;
  /// Takes a connection among the event streams; false if there are too many.
  virtual bool addStream(const std::shared_ptr<HttpConnection>& connection) = 0;
};

/// One client. It lives as long as something is to be read or written.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(boost::asio::ip::tcp::socket socket, HttpHost& host);
  ~HttpConnection();

  void start() { readRequest(); }
  /// Refuses without reading a request.
  void refuse(int status, const std::string& sentence);
  /// Appends bytes to the event stream. Closes it if too many are unsent.
  void stream(const std::string& bytes);
  bool isOpen() const { return !closed_; }
  void close();

 private:
  using Parser = boost::beast::http::request_parser<boost::beast::http::string_body>;
  using Answer = boost::beast::http::response<boost::beast::http::string_body>;
  using FileAnswer = boost::beast::http::response<boost::beast::http::file_body>;

  void readRequest();
  void readRest();
  void answerRequest(boost::beast::error_code error);
  void answerWith(const HttpResponse& response, bool is_head, bool keep_alive);
  void answerDamaged(boost::beast::error_code error);
  void write(const HttpResponse& response, bool is_head, bool keep_alive);
  void writeFile(const HttpResponse& response, bool is_head, bool keep_alive);
  template <class Message>
  void send(Message& message, bool keep_alive);
  void beginStream(const HttpResponse& response);
  void writeStream();
  void watchForEnd();

  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_;
  HttpHost& host_;
  std::optional<Parser> parser_;
  std::optional<Answer> answer_;
  std::optional<FileAnswer> file_answer_;
  std::deque<std::string> unsent_;
  std::size_t unsent_bytes_ = 0;
  char ignored_ = 0;
  bool closed_ = false, is_writing_ = false;
};

}  // namespace omnimapper::server
