#include <omnimapper/base/Error.h>
#include <omnimapper/server/Access.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

namespace omnimapper::server {

namespace {

constexpr char kCookie[] = "omnimapper_token";

std::string lowered(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

/// The value of a cookie in the header field of all cookies; empty if it is not there.
std::string cookieOf(std::string_view all, std::string_view name) {
  while (!all.empty()) {
    const auto end = all.find(';');
    std::string_view pair = all.substr(0, end);
    all = end == std::string_view::npos ? std::string_view() : all.substr(end + 1);
    while (!pair.empty() && pair.front() == ' ') pair.remove_prefix(1);
    if (pair.size() > name.size() && pair.substr(0, name.size()) == name && pair[name.size()] == '=')
      return std::string(pair.substr(name.size() + 1));
  }
  return {};
}

}  // namespace

Access::Access(std::vector<std::string> hosts, std::string token) : token_(std::move(token)) {
  for (auto& host : hosts) hosts_.push_back(lowered(std::move(host)));
}

bool Access::isServedHere(const std::string& host) const {
  return std::find(hosts_.begin(), hosts_.end(), lowered(host)) != hosts_.end();
}

std::optional<HttpResponse> Access::refused(const HttpRequest& request) const {
  if (!isServedHere(request.host))
    return refusal(421, "This server is not reached under that name; omnimapper-serve --host NAME allows it.");
  const bool is_question = request.method == "GET" || request.method == "HEAD";
  if (is_question) return std::nullopt;
  if (request.method != "POST") return refusal(405, "Only GET, HEAD and POST are answered.");
  const auto scheme = request.origin.find("://");
  if (scheme == std::string::npos || !isServedHere(request.origin.substr(scheme + 3)))
    return refusal(403, "Changes are accepted from the page of this server only.");
  if (request.content_type.rfind("application/json", 0) != 0)
    return refusal(415, "A change is a JSON document, with the content type application/json.");
  if (!mayChange(request))
    return refusal(401, "This page may only look: open the address that omnimapper-serve printed, which has a token.");
  return std::nullopt;
}

bool Access::mayChange(const HttpRequest& request) const {
  return areSame(cookieOf(request.cookie, kCookie), token_);
}

HttpResponse Access::enter(const HttpRequest& request) const {
  const auto given = request.values.find("token");
  if (given == request.values.end() || !areSame(given->second, token_))
    return refusal(401, "This token is not that of this server; open the address that omnimapper-serve printed last.");
  HttpResponse response{303, "text/plain; charset=utf-8", "The page is at /.\n"};
  response.fields = {{"Location", "/"},
                     {"Set-Cookie", std::string(kCookie) + "=" + token_ + "; HttpOnly; SameSite=Strict; Path=/"}};
  return response;
}

void Access::protect(HttpResponse& response) {
  const std::array<std::pair<const char*, const char*>, 6> fields{
      {{"Content-Security-Policy",
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
       {"X-Content-Type-Options", "nosniff"},
       {"X-Frame-Options", "DENY"},
       {"Referrer-Policy", "no-referrer"},
       {"Cross-Origin-Resource-Policy", "same-origin"},
       {"Cache-Control", "no-cache"}}};
  for (const auto& [name, value] : fields) response.fields.emplace_back(name, value);
}

std::vector<std::string> hostsAt(const std::string& address, std::uint16_t port) {
  const bool is_ip6 = address.find(':') != std::string::npos;
  const std::string own = is_ip6 ? "[" + address + "]" : address;
  return {own + ":" + std::to_string(port), "localhost:" + std::to_string(port)};
}

std::string randomToken() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw base::Error(base::ExitCode::internal, "the system has no random numbers for a token");
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const unsigned byte : bytes) text += {kDigits[byte / 16], kDigits[byte % 16]};
  return text;
}

bool areSame(const std::string& a, const std::string& b) {
  unsigned different = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    different |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return different == 0;
}

}  // namespace omnimapper::server
