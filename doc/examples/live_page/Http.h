#pragma once

#include <omnimapper/live/Socket.h>

#include <functional>
#include <map>
#include <optional>
#include <string>

namespace live_page {

/// "POST /path?name=value" and the page that it comes from.
struct HttpRequest {
  std::string method, path, origin;
  std::map<std::string, std::string> values;  ///< decoded
};

/// Answers one client, if one has connected, by the HTML that `pageFor` returns; if that is none, the answer is that
/// the request is not valid. A client that sends no whole request within 0.2 s gets no answer.
void answerClient(const omnimapper::live::Descriptor& listening,
                  const std::function<std::optional<std::string>(const HttpRequest&)>& pageFor);

}  // namespace live_page
