#pragma once

#include <omnimapper/perception/OrganisedPoints.h>

#include <vector>

#include "Surfaces.h"

namespace omnimapper::perception::objects {

/// What may lie between a thing and the surface that it is on.
struct RemainderBounds {
  float height;        ///< [m] what is lower is taken for the surface
  float noise_at_1m;   ///< [m], times the squared depth; it adds to the height
  double hull_margin;  ///< [m] beside the surface
};

/// Labels in which whatever lies on a surface is of its first piece: where the plane of a thing's side goes on over the
/// table, pixels are on both, and beside edges some are on neither. `of_place` tells of each label whether its pixels
/// are of a surface or another large plane already: they keep it.
std::vector<std::uint16_t> withRemainders(const PlaneSegmentation& planes, const OrganisedPoints& points,
                                          const std::vector<Surface>& surfaces,
                                          const std::vector<std::uint8_t>& of_place, const RemainderBounds& bounds);

}  // namespace omnimapper::perception::objects
