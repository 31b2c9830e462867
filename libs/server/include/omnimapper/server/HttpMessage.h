#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::server {

/// A request as a handler sees it.
struct HttpRequest {
  std::string method;                         ///< "GET", "HEAD" or "POST"
  std::string path;                           ///< "/api/map", decoded, without its parameters
  std::map<std::string, std::string> values;  ///< parameters behind the "?", decoded; of a repeated name the first
  std::string host, origin, cookie, content_type, if_none_match;  ///< header fields; empty if they are missing
  std::string body;
};

/// The answer to a request.
struct HttpResponse {
  int status = 200;
  std::string content_type = "text/plain; charset=utf-8";
  std::string body;
  std::vector<std::pair<std::string, std::string>> fields = {};  ///< further header fields
  bool is_event_stream = false;  ///< the connection stays open for HttpServer::send(); `body` is its first event
  std::string file = {};         ///< a file that is sent in place of `body`, piece by piece; empty: `body` is sent
  /// If it is set, the answer takes long: this makes it, and may be called in another thread. It must not throw.
  std::function<HttpResponse()> later = {};
};

/// An answer that refuses a request, with a sentence for people.
HttpResponse refusal(int status, const std::string& sentence);

/// Splits "/path?name=value&..." and decodes its %XX and, among the parameters, "+". False if the text is not such a
/// target: it does not begin with "/", or an escape is damaged or stands for a control character.
bool readTarget(const std::string& target, HttpRequest& request);

}  // namespace omnimapper::server
