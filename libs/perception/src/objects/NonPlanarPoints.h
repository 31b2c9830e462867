#pragma once

#include <omnimapper/perception/OrganizedPoints.h>

#include <vector>

#include "Surfaces.h"

namespace omnimapper::perception::objects {

/// How far from a surface a point may be and still belong to it.
struct SurfaceBounds {
  float height;        ///< [m] from the surface's planes
  float noise_at_1m;   ///< [m] at 1 m, times the squared depth; it adds to the height
  double hull_margin;  ///< [m] beside the hull of the surface
};

/// Returns the labels of `planes`, with the points that lie on a surface assigned to its first piece. They may have
/// another label: where the plane of an object's side continues over the table, points are on both planes, and beside
/// edges some are on neither. `of_place`: for each label, whether its pixels are of a surface or another large plane;
/// such pixels keep their labels.
std::vector<std::uint16_t> assignToSurfaces(const PlaneSegmentation& planes, const OrganizedPoints& points,
                                            const std::vector<Surface>& surfaces,
                                            const std::vector<std::uint8_t>& of_place, const SurfaceBounds& bounds);

}  // namespace omnimapper::perception::objects
