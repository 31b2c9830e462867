#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/map/Layers.h>
#include <omnimapper/map/MapSection.h>
#include <omnimapper/map/Places.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace omnimapper::map {

struct Map;

/// What people corrected in a map, in the order of the corrections: its layer "corrections". Later sessions of the map
/// keep to it.
struct Corrections {
  static constexpr char kLayer[] = "corrections";
  static constexpr std::uint32_t kLayerVersion = 1;

  /// A thing that is none: neither shown nor found any more. Its measurements still hold the map together, and new ones
  /// of it are added to it, so that it does not come again.
  struct DeletedThing {
    Place place;      ///< as it was before, to be shown again if that was a mistake
    std::string who;  ///< may be empty
    base::Stamp when;
  };
  /// A loop closure that is wrong: the next session that continues the map removes it.
  struct ForbiddenLoop {
    base::KeyFrameId from, to;
    std::string who;
    base::Stamp when;
  };

  std::vector<DeletedThing> deleted;
  std::vector<ForbiddenLoop> forbidden;

  bool empty() const { return deleted.empty() && forbidden.empty(); }
  std::string toBytes() const;
  /// Throws Error(unreadable_input) if the section is another one, of a later version or damaged.
  static Corrections fromSection(const MapSection& section);
  LayerReferences references() const;
};

/// The landmarks that a place stands for: that of its id, and those of kParts.
std::vector<base::LandmarkId> landmarksOf(const Place& place);

/// The landmarks of a map that people deleted; those into which they were merged in their place.
std::set<base::LandmarkId> deletedLandmarks(const Map& map);

}  // namespace omnimapper::map
