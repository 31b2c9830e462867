#include <omnimapper/building/RoomsEditRun.h>
#include <omnimapper/building/RoomsFile.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/query/editRooms.h>

#include <filesystem>
#include <optional>

#include "MapLock.h"

namespace omnimapper::query {

std::string editRooms(const std::string& path, const std::vector<std::string>& words) {
  const building::RoomsEditRequest request{path, words};
  const std::string folder = building::editedFolder(request);
  const std::string file = (std::filesystem::path(folder) / "map.omnimap").string();
  const MapLock lock(folder);
  std::optional<map::MapFile> map;
  if (std::filesystem::exists(file)) map = map::MapFile::read(file);
  const auto result = building::runRoomsEdit(request);
  if (map) {
    map->set({building::kRoomsLayer, building::kRoomsLayerVersion, result.rooms});
    map->write(file);
  }
  return result.text;
}

}  // namespace omnimapper::query
