#pragma once

#include <omnimapper/map/Landmark.h>

#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>

namespace omnimapper::map {

/// How each kind of landmark payload is read back.
class PayloadRegistry {
 public:
  /// Reads what LandmarkPayload::write() wrote. Throws base::Error if the bytes do not fit.
  using Reader = std::function<std::shared_ptr<const LandmarkPayload>(std::istream&)>;

  /// Throws Error(internal) if the kind is taken.
  void add(const std::string& kind, Reader reader);
  /// A kind that nobody registered gives a payload that keeps the bytes and writes them again as they are.
  /// Throws Error(unreadable_input) if the reader leaves bytes over, and what it throws.
  std::shared_ptr<const LandmarkPayload> read(const std::string& kind, const std::string& bytes) const;

 private:
  std::map<std::string, Reader> readers_;
};

}  // namespace omnimapper::map
