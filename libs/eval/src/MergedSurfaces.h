#pragma once

#include <omnimapper/eval/ViewAgreement.h>

#include <vector>

#include "CoveredSurface.h"

namespace omnimapper::eval {

/// A plane of a view, with the cells that count for the comparison.
struct PlaneCells {
  std::size_t view = 0, plane = 0;
  CoveredSurface covered;
};

/// Share of the cells of `smaller` that lie on the cells of `larger`.
double sharedShare(const CoveredSurface& smaller, const CoveredSurface& larger, const MapQualityOptions& options);

/// Whether the surfaces lie on each other: they share overlap_share of the smaller one.
bool areSame(const CoveredSurface& a, const CoveredSurface& b, const MapQualityOptions& options);

/// Unites planes that lie on each other, beginning with the largest. Every part of a united surface lies on the plane
/// of its largest, so that a chain of planes does not climb from a table to the books on it. Each plane is part of
/// exactly one surface; the largest surface comes first.
std::vector<MergedSurface> unitePlanes(const std::vector<PlaneCells>& planes, const MapQualityOptions& options);

}  // namespace omnimapper::eval
