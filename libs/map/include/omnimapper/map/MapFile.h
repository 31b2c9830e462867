#pragma once

#include <omnimapper/map/Map.h>
#include <omnimapper/map/PayloadRegistry.h>
#include <omnimapper/map/Places.h>

#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::map {

/// One named part of a map file. Who owns it knows what its bytes mean at its version.
struct MapSection {
  std::string name;
  std::uint32_t version = 1;
  std::string bytes;
};

/// The container `map.omnimap`: sections with a checksum each. Sections nobody knows are kept as they are.
class MapFile {
 public:
  /// Throws Error(unreadable_input) if it is no map file, was written by a later format, or a checksum fails.
  static MapFile read(const std::string& path);
  /// Only the sections of these names, as far as the file has them. It seeks over the others, so that their size costs
  /// nothing and their checksums are not looked at. Throws as read().
  static MapFile readOnly(const std::string& path, const std::vector<std::string>& names);
  /// Atomically: at any moment `path` holds a whole map. Throws Error(disk_full).
  void write(const std::string& path) const;

  /// Replaces the section of that name or appends it.
  void set(MapSection section);
  /// Null if the file has none of that name.
  const MapSection* find(const std::string& name) const;
  const std::vector<MapSection>& sections() const { return sections_; }

 private:
  std::vector<MapSection> sections_;
};

/// The "frames" section: every key frame with its observations.
MapSection framesToSection(const Map& map);
/// How many bytes all its key frames have when they are not compressed; of damaged bytes any number.
std::uint64_t uncompressedSize(const MapSection& frames);
/// A map of nothing else. Throws Error(unreadable_input) if the bytes are not frames of a known version.
Map framesFromSection(const MapSection& section);

/// The "landmarks" section. A payload of a kind that nobody registered keeps its bytes.
MapSection landmarksToSection(const Map& map);
/// Throws Error(unreadable_input) as framesFromSection(), and what the readers of payloads throw.
base::IdTable<base::LandmarkId, Landmark> landmarksFromSection(const MapSection& section,
                                                               const PayloadRegistry& payloads);

/// The "sessions" section.
MapSection sessionsToSection(const Map& map);
/// Throws Error(unreadable_input) as framesFromSection().
std::vector<Session> sessionsFromSection(const MapSection& section);
/// The sessions of a map from before there was such a section: one for each number that key frames carry, joined, its
/// anchor the pose of its first key frame.
std::vector<Session> sessionsOfFrames(const KeyFrames& key_frames);

/// The name of the section that holds what a query needs. Every run that writes a map makes it anew, so whoever loads a
/// map to go on from it leaves it out.
inline constexpr char kPlacesSection[] = "places";
MapSection placesToSection(const Places& places);
/// Throws Error(unreadable_input) as framesFromSection(), and where a number is not finite or a direction is none.
Places placesFromSection(const MapSection& section);

/// The "level" section, of maps whose level was estimated.
MapSection levelToSection(const Level& level);
/// Throws Error(unreadable_input) as framesFromSection(), and where up is no direction.
Level levelFromSection(const MapSection& section);

}  // namespace omnimapper::map
