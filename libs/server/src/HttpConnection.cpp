#include "HttpConnection.h"

#include <boost/asio/write.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <chrono>
#include <utility>

namespace omnimapper::server {

namespace beast = boost::beast;
namespace http = beast::http;
using beast::error_code;

namespace {

constexpr unsigned kHttp11 = 11;

std::string fieldOf(const http::request<http::string_body>& message, http::field field) {
  return std::string(message[field]);
}

HttpRequest requestOf(http::request<http::string_body>& message) {
  HttpRequest request;
  request.method = std::string(message.method_string());
  request.host = fieldOf(message, http::field::host);
  request.origin = fieldOf(message, http::field::origin);
  request.cookie = fieldOf(message, http::field::cookie);
  request.content_type = fieldOf(message, http::field::content_type);
  request.if_none_match = fieldOf(message, http::field::if_none_match);
  request.body = std::move(message.body());
  return request;
}

template <class Body = http::string_body>
http::response<Body> messageOf(const HttpResponse& response) {
  http::response<Body> message(static_cast<http::status>(response.status), kHttp11);
  message.set(http::field::content_type, response.content_type);
  for (const auto& [name, value] : response.fields) message.set(name, value);
  return message;
}

}  // namespace

HttpConnection::HttpConnection(boost::asio::ip::tcp::socket socket, HttpHost& host)
    : stream_(std::move(socket)),
      // A whole header, and a piece of the body behind it.
      buffer_(2 * host.limits().header_bytes),
      host_(host) {}

HttpConnection::~HttpConnection() = default;

void HttpConnection::close() {
  closed_ = true;
  error_code ignored;
  stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_both, ignored);
  stream_.socket().close(ignored);
}

void HttpConnection::readRequest() {
  parser_.emplace();
  parser_->header_limit(static_cast<std::uint32_t>(host_.limits().header_bytes));
  parser_->body_limit(host_.limits().body_bytes);
  stream_.expires_after(std::chrono::seconds(host_.limits().idle_s));
  // The first byte begins the time of the request.
  if (buffer_.size() > 0) return readRest();
  stream_.async_read_some(buffer_.prepare(host_.limits().header_bytes),
                          [self = shared_from_this()](error_code error, std::size_t size) {
                            if (error) return self->close();
                            self->buffer_.commit(size);
                            self->readRest();
                          });
}

void HttpConnection::readRest() {
  stream_.expires_after(std::chrono::seconds(host_.limits().request_s));
  http::async_read(stream_, buffer_, *parser_,
                   [self = shared_from_this()](error_code error, std::size_t) { self->answerRequest(error); });
}

void HttpConnection::answerDamaged(error_code error) {
  const auto& limits = host_.limits();
  if (error == http::error::header_limit || error == http::error::buffer_overflow)
    return refuse(431, "The header of a request may have " + std::to_string(limits.header_bytes) + " bytes.");
  if (error == http::error::body_limit)
    return refuse(413, "The body of a request may have " + std::to_string(limits.body_bytes) + " bytes.");
  if (error.category() == make_error_code(http::error::bad_method).category() && error != http::error::end_of_stream &&
      error != http::error::partial_message)
    return refuse(400, "This is no HTTP request: " + error.message() + ".");
  close();
}

void HttpConnection::answerRequest(error_code error) {
  if (error) return answerDamaged(error);
  auto message = parser_->release();
  const bool is_head = message.method() == http::verb::head;
  if (message.count(http::field::content_encoding) > 0)
    return refuse(415, "The body of a request must not be compressed.");
  if (message.count(http::field::host) > 1) return refuse(400, "A request names one host.");
  HttpRequest request = requestOf(message);
  if (!readTarget(std::string(message.target()), request)) return refuse(400, "The address of the request is damaged.");
  const HttpResponse response = host_.answer(request);
  const bool keep_alive = message.keep_alive();
  if (!response.later) return answerWith(response, is_head, keep_alive);
  const bool is_taken =
      host_.answerLater(response.later, [self = shared_from_this(), is_head, keep_alive](const HttpResponse& made) {
        if (self->isOpen()) self->answerWith(made, is_head, keep_alive);
      });
  if (!is_taken) refuse(503, "Too many questions wait for an answer; ask again in a moment.");
}

void HttpConnection::answerWith(const HttpResponse& response, bool is_head, bool keep_alive) {
  if (response.is_event_stream && !is_head) return beginStream(response);
  if (response.file.empty()) return write(response, is_head, keep_alive);
  writeFile(response, is_head, keep_alive);
}

void HttpConnection::refuse(int status, const std::string& sentence) {
  write(refusal(status, sentence), false, false);
}

template <class Message>
void HttpConnection::send(Message& message, bool keep_alive) {
  message.keep_alive(keep_alive);
  stream_.expires_after(std::chrono::seconds(host_.limits().answer_s));
  http::async_write(stream_, message, [self = shared_from_this(), keep_alive](error_code error, std::size_t) {
    if (error || !keep_alive) return self->close();
    self->file_answer_.reset();
    self->readRequest();
  });
}

void HttpConnection::write(const HttpResponse& response, bool is_head, bool keep_alive) {
  answer_ = messageOf(response);
  answer_->body() = response.body;
  answer_->prepare_payload();
  if (is_head) answer_->body().clear();
  send(*answer_, keep_alive);
}

// A file is read while it is sent, so that no client makes the server keep it in memory.
void HttpConnection::writeFile(const HttpResponse& response, bool is_head, bool keep_alive) {
  http::file_body::value_type file;
  error_code error;
  file.open(response.file.c_str(), beast::file_mode::scan, error);
  if (error) return write(refusal(404, "This file of the map is not there any more."), is_head, keep_alive);
  if (is_head) {
    answer_ = messageOf(response);
    answer_->content_length(file.size());
    return send(*answer_, keep_alive);
  }
  file_answer_ = messageOf<http::file_body>(response);
  file_answer_->body() = std::move(file);
  file_answer_->prepare_payload();
  send(*file_answer_, keep_alive);
}

void HttpConnection::beginStream(const HttpResponse& response) {
  if (!host_.addStream(shared_from_this())) return refuse(503, "There are too many pages open; close one.");
  auto header = messageOf(response);
  header.keep_alive(false);
  std::string bytes = "HTTP/1.1 200 OK\r\n";
  for (const auto& field : header)
    bytes += std::string(field.name_string()) + ": " + std::string(field.value()) + "\r\n";
  stream(bytes + "\r\n" + response.body);
  watchForEnd();
}

void HttpConnection::stream(const std::string& bytes) {
  if (closed_) return;
  unsent_bytes_ += bytes.size();
  if (unsent_bytes_ > host_.limits().unsent_bytes) return close();
  unsent_.push_back(bytes);
  if (!is_writing_) writeStream();
}

void HttpConnection::writeStream() {
  if (closed_) return;
  is_writing_ = !unsent_.empty();
  if (!is_writing_) return stream_.expires_never();
  stream_.expires_after(std::chrono::seconds(host_.limits().answer_s));
  boost::asio::async_write(stream_, boost::asio::buffer(unsent_.front()),
                           [self = shared_from_this()](error_code error, std::size_t) {
                             if (error) return self->close();
                             self->unsent_bytes_ -= self->unsent_.front().size();
                             self->unsent_.pop_front();
                             self->writeStream();
                           });
}

// A client of an event stream sends nothing more, so whatever can be read ends it.
void HttpConnection::watchForEnd() {
  stream_.socket().async_read_some(boost::asio::buffer(&ignored_, 1),
                                   [self = shared_from_this()](error_code, std::size_t) { self->close(); });
}

}  // namespace omnimapper::server
