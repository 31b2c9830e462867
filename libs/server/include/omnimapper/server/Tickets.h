#pragma once

#include <omnimapper/base/Stamp.h>

#include <map>
#include <string>

namespace omnimapper::server {

/// Each ticket lets one command through, so that none is given twice or long after it was meant.
class Tickets {
 public:
  static constexpr double kValid = 60;  ///< [s]

  /// A new ticket; at most 100 wait to be used, and the oldest is forgotten.
  std::string give(base::Stamp now);
  /// Whether the ticket was given less than kValid ago and not used yet. It is used then.
  bool use(const std::string& ticket, base::Stamp now);

 private:
  std::map<std::string, base::Stamp> given_;
};

}  // namespace omnimapper::server
