#pragma once

#include <omnimapper/landmarks/LandmarkMerging.h>

#include <string>

#include "KnownObject.h"
#include "ObjectLandmarksOptions.h"

namespace omnimapper::plugins {

/// Finds the objects that are one, if the covariance of the map allows the gap between the middles of their boxes:
/// those that were found in pieces, where the points of both lie near those of the other, and parts of a whole, where
/// only those of one do, unless an image shows both. Of two that are merged, the older one stays.
landmarks::LandmarkMerging<ObjectPayload> mergeObjects(const ObjectIndex& known, const ObjectLandmarksOptions& options,
                                                       const std::string& section, const mapper::View& view);

/// The model of an object without the points of those that stand on it or touch it, which images did not tell apart
/// from it at first: of confirmed objects that were seen beside it in one image, and most of whose points are also in
/// its model, but not the other way round.
ObjectModel withoutOthers(const KnownObject& object, const ObjectModel& model, const ObjectIndex& known,
                          const ObjectLandmarksOptions& options, const mapper::View& view);

}  // namespace omnimapper::plugins
