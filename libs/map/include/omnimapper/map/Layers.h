#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/map/MapSection.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace omnimapper::map {

/// What a layer refers to. A map that lacks one of these is damaged.
struct LayerReferences {
  std::vector<base::KeyFrameId> key_frames;
  std::vector<base::LandmarkId> landmarks;
  std::vector<base::VariableId> variables;
};

/// Data of a map beside its key frames and landmarks, such as the place on earth or the rooms. The name of a layer is
/// unique in its map and names a section of the map file. A layer is immutable; a plugin that learns more sets a new
/// one.
class Layer {
 public:
  virtual ~Layer() = default;
  /// The version of the format of bytes(), at least 1.
  virtual std::uint32_t version() const = 0;
  /// The layer in the map file; the reader of its name takes these bytes.
  virtual std::string bytes() const = 0;
  virtual LayerReferences references() const { return {}; }
};

/// A layer that is kept as the bytes from which it was read: the saved state of a plugin, or a layer that no loaded
/// plugin knows.
struct RawLayer final : Layer {
  RawLayer(std::uint32_t version, std::string bytes) : version_(version), bytes_(std::move(bytes)) {}
  std::uint32_t version() const override { return version_; }
  std::string bytes() const override { return bytes_; }

 private:
  std::uint32_t version_;
  std::string bytes_;
};

/// A layer that holds a struct T with these members:
///   static constexpr char kLayer[]                           the layer's name, unless another is given
///   static constexpr std::uint32_t kLayerVersion             the version that toBytes() writes
///   std::string toBytes() const
///   static T fromSection(const MapSection&)                  throws Error(unreadable_input), also at a later version
///   LayerReferences references() const                       optional
template <class T>
struct LayerOf final : Layer {
  explicit LayerOf(T held) : value(std::move(held)) {}
  std::uint32_t version() const override { return T::kLayerVersion; }
  std::string bytes() const override { return value.toBytes(); }
  LayerReferences references() const override { return referencesOf(value, 0); }

  const T value;

 private:
  template <class U>
  static auto referencesOf(const U& held, int) -> decltype(held.references()) {
    return held.references();
  }
  template <class U>
  static LayerReferences referencesOf(const U&, long) {
    return {};
  }
};

/// Whether a layer may have this name: it is not empty, at most 256 bytes long, and is none of the names of the other
/// sections of a map file.
bool isLayerName(std::string_view name);

/// The layers of a map by name. Copies share the layers.
class Layers {
 public:
  using ByName = std::map<std::string, std::shared_ptr<const Layer>, std::less<>>;

  /// The layer of that name as a T; null if there is none, or if it holds another type.
  template <class T>
  const T* find(std::string_view name = T::kLayer) const {
    const auto* layer = dynamic_cast<const LayerOf<T>*>(find(name).get());
    return layer ? &layer->value : nullptr;
  }
  /// Null if there is no layer of that name.
  std::shared_ptr<const Layer> find(std::string_view name) const;

  /// Adds the layer or replaces that of the same name. Throws Error(internal) unless isLayerName(name).
  template <class T>
  void set(T value, const std::string& name = T::kLayer) {
    set(name, std::make_shared<const LayerOf<T>>(std::move(value)));
  }
  void set(const std::string& name, std::shared_ptr<const Layer> layer);
  void remove(std::string_view name);

  bool empty() const { return by_name_.empty(); }
  std::size_t size() const { return by_name_.size(); }
  ByName::const_iterator begin() const { return by_name_.begin(); }
  ByName::const_iterator end() const { return by_name_.end(); }

 private:
  ByName by_name_;
};

/// The section of a map file that holds a layer.
MapSection layerToSection(const std::string& name, const Layer& layer);

/// The readers of all layers that are more than bytes to this program, by name.
class LayerRegistry {
 public:
  using Reader = std::function<std::shared_ptr<const Layer>(const MapSection&)>;

  template <class T>
  void add(const std::string& name = T::kLayer) {
    add(name, [](const MapSection& section) { return std::make_shared<const LayerOf<T>>(T::fromSection(section)); });
  }
  /// Throws Error(internal) if the name is registered already, or cannot be that of a layer.
  void add(const std::string& name, Reader reader);
  /// A layer of an unregistered name becomes a RawLayer. Throws whatever the reader throws.
  std::shared_ptr<const Layer> read(const MapSection& section) const;

 private:
  std::map<std::string, Reader> readers_;
};

}  // namespace omnimapper::map
