#pragma once

#include <map>
#include <memory>
#include <string>
#include <typeindex>
#include <utility>

namespace omnimapper::mapper {

/// What the outputs of a finished map have in common, such as its grid: computed by the first that needs it, then kept
/// until all have been written. Plugins that conclude the map share it, too, until one of them changes graph or
/// landmarks. Not thread-safe.
class SharedResults {
 public:
  /// The T of that key, which `compute()` returns if nobody computed it before. The key must name all that the result
  /// depends on beside the finished map.
  template <class T, class Compute>
  std::shared_ptr<const T> get(const std::string& key, const Compute& compute) {
    auto& kept = kept_[{std::type_index(typeid(T)), key}];
    if (!kept) kept = std::make_shared<const T>(compute());
    return std::static_pointer_cast<const T>(kept);
  }

 private:
  std::map<std::pair<std::type_index, std::string>, std::shared_ptr<const void>> kept_;
};

}  // namespace omnimapper::mapper
