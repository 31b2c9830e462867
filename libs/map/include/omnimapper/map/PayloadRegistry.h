#pragma once

#include <omnimapper/map/Landmark.h>

#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>

namespace omnimapper::map {

/// The readers of all kinds of landmark payloads.
class PayloadRegistry {
 public:
  /// Reads what LandmarkPayload::write() wrote. Throws base::Error if the bytes are not such a payload.
  using Reader = std::function<std::shared_ptr<const LandmarkPayload>(std::istream&)>;

  /// Throws Error(internal) if the kind is registered already.
  void add(const std::string& kind, Reader reader);
  /// For an unregistered kind it returns a payload that keeps the bytes and writes them unchanged.
  /// Throws Error(unreadable_input) if the reader leaves bytes unread, and whatever the reader throws.
  std::shared_ptr<const LandmarkPayload> read(const std::string& kind, const std::string& bytes) const;

 private:
  std::map<std::string, Reader> readers_;
};

}  // namespace omnimapper::map
