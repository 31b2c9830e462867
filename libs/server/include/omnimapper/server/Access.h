#pragma once

#include <omnimapper/server/HttpMessage.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::server {

/// Who may ask what. Other pages in the same browser and other users of the machine reach a port of this machine, too:
/// a request must name a host that is served here, and one that changes something must come from a page of this server
/// with the token of its user (doc/security.md).
class Access {
 public:
  /// `hosts`: names under which the server is reached, with ports if they are not 80: "127.0.0.1:8080".
  Access(std::vector<std::string> hosts, std::string token);

  /// Why the request is refused; none if it may be answered. What is not GET or HEAD is taken for a change.
  std::optional<HttpResponse> refused(const HttpRequest& request) const;

  /// Whether the request carries the token in its cookie.
  bool mayChange(const HttpRequest& request) const;

  /// The answer to "/enter?token=...": sets the cookie and leads to the page, or refuses.
  HttpResponse enter(const HttpRequest& request) const;

  /// Adds the header fields that keep a browser from framing the page, guessing types, loading from elsewhere, or
  /// telling others where it was.
  static void protect(HttpResponse& response);

 private:
  bool isServedHere(const std::string& host) const;

  std::vector<std::string> hosts_;
  std::string token_;
};

/// The names under which a browser on this machine reaches a numeric address and port; the first one has the address.
std::vector<std::string> hostsAt(const std::string& address, std::uint16_t port);

/// 128 random bits of the system in hexadecimal digits. Throws Error(internal) if it has none.
std::string randomToken();

/// Whether both texts are the same; takes the same time wherever they differ.
bool areSame(const std::string& a, const std::string& b);

}  // namespace omnimapper::server
