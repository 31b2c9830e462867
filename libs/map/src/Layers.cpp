#include <omnimapper/base/Error.h>
#include <omnimapper/map/Layers.h>

#include <algorithm>
#include <array>

namespace omnimapper::map {

bool isLayerName(std::string_view name) {
  constexpr std::array<std::string_view, 4> kOthers{"graph", "frames", "landmarks", "sessions"};
  constexpr std::size_t kLongest = 256;  // a map file with a longer one is refused
  return !name.empty() && name.size() <= kLongest && std::find(kOthers.begin(), kOthers.end(), name) == kOthers.end();
}

namespace {

void expectLayerName(const std::string& name) {
  if (!isLayerName(name)) {
    throw base::Error(base::ExitCode::internal, "a layer cannot be called \"" + name +
                                                    "\": the name is empty, too long or that of another section");
  }
}

}  // namespace

std::shared_ptr<const Layer> Layers::find(std::string_view name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : found->second;
}

void Layers::set(const std::string& name, std::shared_ptr<const Layer> layer) {
  expectLayerName(name);
  by_name_[name] = std::move(layer);
}

void Layers::remove(std::string_view name) {
  const auto found = by_name_.find(name);
  if (found != by_name_.end()) by_name_.erase(found);
}

MapSection layerToSection(const std::string& name, const Layer& layer) {
  return {name, layer.version(), layer.bytes()};
}

void LayerRegistry::add(const std::string& name, Reader reader) {
  expectLayerName(name);
  if (!readers_.emplace(name, std::move(reader)).second)
    throw base::Error(base::ExitCode::internal, "two readers are registered for the layer \"" + name + "\"");
}

std::shared_ptr<const Layer> LayerRegistry::read(const MapSection& section) const {
  const auto reader = readers_.find(section.name);
  if (reader != readers_.end()) return reader->second(section);
  return std::make_shared<const RawLayer>(section.version, section.bytes);
}

}  // namespace omnimapper::map
