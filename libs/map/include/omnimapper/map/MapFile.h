#pragma once

#include <omnimapper/map/Map.h>
#include <omnimapper/map/MapSection.h>
#include <omnimapper/map/PayloadRegistry.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace omnimapper::map {

/// The container `map.omnimap`: sections with a checksum each. Sections of unknown names are kept unchanged.
class MapFile {
 public:
  /// Throws Error(unreadable_input) if it is not a map file, has a later format, or fails a checksum.
  static MapFile read(const std::string& path);
  /// Reads only the sections of these names, as far as the file has them. All other sections are skipped, so their size
  /// costs no time, and their checksums are not verified. Throws as read().
  static MapFile readOnly(const std::string& path, const std::vector<std::string>& names);
  struct Entry {
    std::string name;
    std::uint32_t version = 1;
    std::uint64_t size = 0;  ///< [bytes]
  };
  /// What sections the file has, in their order, without reading them. Throws as readOnly().
  static std::vector<Entry> list(const std::string& path);
  /// Writes atomically: at any time `path` holds a complete map. Throws Error(disk_full).
  void write(const std::string& path) const;

  /// Replaces the section of that name or appends it.
  void set(MapSection section);
  /// Does nothing if the file has no section of that name.
  void remove(const std::string& name);
  /// Null if the file has no section of that name.
  const MapSection* find(const std::string& name) const;
  const std::vector<MapSection>& sections() const { return sections_; }

 private:
  std::vector<MapSection> sections_;
};

/// The "frames" section: every key frame with its observations.
MapSection framesToSection(const Map& map);
/// Size of all its key frames without compression [bytes]; an arbitrary number if the section is damaged.
std::uint64_t uncompressedSize(const MapSection& frames);
/// A map that has only these key frames. Throws Error(unreadable_input) if the bytes are not frames of a known version.
Map framesFromSection(const MapSection& section);
/// The same without observations and clouds, which are not read: what trajectories need. At least one key frame. Throws
/// Error(unreadable_input) as framesFromSection(), and if a pose is not finite.
Map bareFramesFromSection(const MapSection& section);

/// Where a key frame is.
struct FramePose {
  base::KeyFrameId id;
  mrpt::poses::CPose3D map_from_base;
};
/// The poses of all key frames in the "frames" section, whose observations are not read. At least one. Throws
/// Error(unreadable_input) if the bytes are not frames of a known version, or a pose is not finite.
std::vector<FramePose> framePosesFromSection(const MapSection& section);

/// The "landmarks" section. A payload of an unregistered kind is written as the bytes from which it was read.
MapSection landmarksToSection(const Map& map);
/// Throws Error(unreadable_input) as framesFromSection(), and whatever the readers of payloads throw.
base::IdTable<base::LandmarkId, Landmark> landmarksFromSection(const MapSection& section,
                                                               const PayloadRegistry& payloads);

/// The landmark that is there now for each landmark of the "landmarks" section, whose payloads are not read: itself, or
/// the one that it was merged into. Throws Error(unreadable_input) if the bytes are not landmarks of a known version.
std::map<base::LandmarkId, base::LandmarkId> currentLandmarks(const MapSection& section);

/// The "sessions" section.
MapSection sessionsToSection(const Map& map);
/// Throws Error(unreadable_input) as framesFromSection().
std::vector<Session> sessionsFromSection(const MapSection& section);
/// The sessions of an old map that lacks this section: one session for each session number of the key frames. Each
/// session is aligned, and its anchor is the pose of its first key frame.
std::vector<Session> sessionsOfFrames(const KeyFrames& key_frames);

}  // namespace omnimapper::map
