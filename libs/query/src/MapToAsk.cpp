#include <omnimapper/base/Error.h>
#include <omnimapper/building/RoomsFile.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/map/Places.h>
#include <omnimapper/query/MapToAsk.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace omnimapper::query {

namespace {

namespace fs = std::filesystem;

constexpr char kCheckpoint[] = "checkpoint.omnimap";

[[noreturn]] void refuseMap(const std::string& file, const std::string& reason) {
  throw base::Error(base::ExitCode::unreadable_input, file + ": " + reason);
}

std::string mapFileAt(const std::string& path) {
  std::error_code none;
  if (path.empty())
    throw base::Error(base::ExitCode::command_line, "MAP is empty: name the folder of a map, or its map.omnimap");
  if (!fs::is_directory(path, none)) return path;
  const fs::path map = fs::path(path) / "map.omnimap", checkpoint = fs::path(path) / kCheckpoint;
  // While a live run goes on, or after it crashed, there is only its checkpoint.
  if (!fs::exists(map, none) && fs::exists(checkpoint, none)) return checkpoint;
  if (!fs::exists(map, none))
    refuseMap(path,
              "has no map.omnimap: it is not the folder of a map. omnimapper-graphslam -o FOLDER makes one "
              "if [mapper] output_plugins names a MapOutput.");
  return map;
}

// The FNV-1a hash of some bytes, begun with `hash`.
std::uint64_t hashed(const std::string& bytes, std::uint64_t hash) {
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  return hash;
}

std::string hexadecimal(std::uint64_t number) {
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}

// None if the layer is of another program, or of a later version of this one.
std::optional<building::Storey> roomsIn(const map::MapSection& section) {
  if (section.version != building::kRoomsLayerVersion) return std::nullopt;
  try {
    return building::decodeRooms(section.bytes, section.name).building.storeys.front();
  } catch (const base::Error&) {
    return std::nullopt;
  }
}

}  // namespace

bool isCheckpoint(const std::string& file) {
  return fs::path(file).filename() == kCheckpoint;
}

MapToAsk openMap(const std::string& path) {
  MapToAsk opened;
  opened.file = mapFileAt(path);
  opened.folder = fs::path(opened.file).parent_path();
  if (opened.folder.empty()) opened.folder = ".";
  const auto file = map::MapFile::readOnly(
      opened.file, {map::Places::kLayer, building::kRoomsLayer, map::ClosedLoops::kLayer, map::Corrections::kLayer});
  const auto* section = file.find(map::Places::kLayer);
  if (!section)
    refuseMap(opened.file, "has no section \"" + std::string(map::Places::kLayer) +
                               "\", which queries need: an earlier OmniMapper wrote it. Map its "
                               "log again, or continue it with omnimapper-graphslam --continue.");
  try {
    opened.places = map::Places::fromSection(*section);
    if (const auto* loops = file.find(map::ClosedLoops::kLayer))
      opened.loops = map::ClosedLoops::fromSection(*loops).loops;
    if (const auto* corrections = file.find(map::Corrections::kLayer))
      opened.corrections = map::Corrections::fromSection(*corrections);
  } catch (const base::Error& error) {
    throw base::Error(error.code(), opened.file + ": " + error.what());
  }
  std::uint64_t hash = hashed(section->bytes, 0xcbf29ce484222325ULL);
  if (const auto* rooms = file.find(building::kRoomsLayer)) {
    opened.rooms = roomsIn(*rooms);
    hash = hashed(rooms->bytes, hash);
  }
  opened.id = hexadecimal(hash);
  for (auto& entry : map::MapFile::list(opened.file))
    if (map::isLayerName(entry.name)) opened.layers.push_back(std::move(entry));
  return opened;
}

}  // namespace omnimapper::query
