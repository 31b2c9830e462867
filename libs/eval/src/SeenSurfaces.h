#pragma once

#include <omnimapper/eval/ViewAgreement.h>

#include <vector>

#include "CoveredSurface.h"

namespace omnimapper::eval {

/// A plane of a view, with the cells that count.
struct ViewPlane {
  std::size_t view = 0, plane = 0;
  CoveredSurface covered;
};

/// Share of the cells of `smaller` that lie on the cells of `larger`.
double sharedShare(const CoveredSurface& smaller, const CoveredSurface& larger, const MapQualityOptions& options);

/// Whether they lie on each other: a fifth of the smaller one is shared.
bool areSame(const CoveredSurface& a, const CoveredSurface& b, const MapQualityOptions& options);

/// Planes that lie on each other, united from the largest on. All of what is united lies on the plane of the largest,
/// so that a chain of planes does not climb from a table to the books on it. Each plane is part of one; the largest
/// first.
std::vector<SeenSurface> unitePlanes(const std::vector<ViewPlane>& planes, const MapQualityOptions& options);

}  // namespace omnimapper::eval
