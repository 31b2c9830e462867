#pragma once

#include <memory>
#include <typeindex>
#include <utility>
#include <vector>

namespace omnimapper::perception {

/// What was made of one observation on the way through pose plugins, extractors and MeasurementPlugin::prepare(), for
/// those who would make the same again. An object on it must be determined by the observation and by options that the
/// object itself states, so that whoever uses it gets what he would have made. Objects may point into the observation,
/// which therefore must outlive the blackboard and its copies. One thread at a time uses a blackboard; a copy has the
/// same objects.
class Blackboard {
 public:
  /// Adds an object, never null. There may be several of one type.
  template <class T>
  void put(std::shared_ptr<const T> object) {
    objects_.emplace_back(typeid(T), std::move(object));
  }
  /// The first object of this type for which `fits` is true; null if there is none.
  template <class T, class Fits>
  std::shared_ptr<const T> find(const Fits& fits) const {
    for (const auto& [type, object] : objects_) {
      if (type != typeid(T)) continue;
      auto found = std::static_pointer_cast<const T>(object);
      if (fits(*found)) return found;
    }
    return nullptr;
  }
  template <class T>
  std::shared_ptr<const T> find() const {
    return find<T>([](const T&) { return true; });
  }
  /// The first object of this type. If there is none, the std::shared_ptr<const T> that make() returns is added; what
  /// it throws comes through.
  template <class T, class Make>
  const T& get(const Make& make) {
    if (const auto found = find<T>()) return *found;
    put<T>(make());
    return *find<T>();
  }

 private:
  std::vector<std::pair<std::type_index, std::shared_ptr<const void>>> objects_;  // a few
};

}  // namespace omnimapper::perception
