#pragma once

#include <omnimapper/map/Labels.h>
#include <omnimapper/map/Places.h>

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace omnimapper::map {

/// What labels refer to in a map.
struct LabelAnchors {
  std::function<base::LandmarkId(base::LandmarkId)> landmark;  ///< the landmark that is there now: follows merges
  std::function<Eigen::Vector3d(const Label&)> point;          ///< the named point in the frame of the map [m]
};

/// The property of a place that is a name which somebody gave to it.
inline constexpr char kName[] = "name";

/// Adds what people named to the places of a map. A landmark with a name has it as the property kName; a name of the
/// face of a thing is that of the thing. Several landmarks of one name are one more place, a "region": the convex hull
/// of all of them, seen from above (thesis 6.2.2.1). A name of a place, or of a landmark that is not among the places,
/// is a "place" of one point. The ids of regions and places are those of no landmarks.
void addLabels(const Labels& labels, const LabelAnchors& anchors, std::vector<Place>& places);

/// Removes what addLabels() added.
void removeLabels(std::vector<Place>& places);

/// The place of a landmark, which may be the face of a thing; the end of the list if there is none.
std::vector<Place>::iterator placeWithLandmark(std::vector<Place>& places, base::LandmarkId id);

}  // namespace omnimapper::map
