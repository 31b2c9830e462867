#pragma once

#include <map>
#include <optional>
#include <vector>

#include "KnownObject.h"

namespace omnimapper::plugins {

/// An object of the map as it is compared with others.
struct PieceCandidate {
  base::LandmarkId id;
  ObjectGeometry geometry;
  /// [m] Height of its base above the surface below it, such as a table; none if no surface is known there.
  std::optional<double> height;
};

/// Which of these objects are pieces of others: a concave edge cuts the shade of a lamp from its post, the inside of a
/// bowl from its outside, and a plant into bunches of leaves. Two solid things can neither hang in the air nor fill one
/// volume. So a piece
///  - stands neither on its surface nor on the top of another object that could carry it, and touches an object below,
///    above or around it, or
///  - fills for the most part the volume of another one.
/// Things that stand on one another or side by side are no pieces, however close they are. Returns, for each piece, the
/// object that it belongs to: of those that belong together the one with the most points.
std::map<base::LandmarkId, base::LandmarkId> findPieces(const std::vector<PieceCandidate>& objects);

}  // namespace omnimapper::plugins
