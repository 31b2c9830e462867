#include <omnimapper/server/Access.h>
#include <omnimapper/server/Tickets.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::server {

std::string Tickets::give(base::Stamp now) {
  constexpr std::size_t kMost = 100;
  if (given_.size() == kMost)
    given_.erase(std::min_element(given_.begin(), given_.end(),
                                  [](const auto& a, const auto& b) { return a.second < b.second; }));
  const std::string ticket = randomToken();
  given_[ticket] = now;
  return ticket;
}

bool Tickets::use(const std::string& ticket, base::Stamp now) {
  const auto found = given_.find(ticket);
  if (found == given_.end()) return false;
  // Also after the clock was set back.
  const bool is_fresh = std::abs(base::secondsBetween(found->second, now)) < kValid;
  given_.erase(found);
  return is_fresh;
}

}  // namespace omnimapper::server
