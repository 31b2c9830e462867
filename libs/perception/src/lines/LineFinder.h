#pragma once

#include <memory>
#include <vector>

#include "ScanPoints.h"

namespace omnimapper::perception::lines {

/// Finds roughly which points of a scan lie on one line. The lines are in the order of their first points.
class LineFinder {
 public:
  virtual ~LineFinder() = default;
  virtual std::vector<Stretch> find(const ScanPoints& points) const = 0;
};

std::unique_ptr<LineFinder> makeRansac(const LaserLineOptions& options);
std::unique_ptr<LineFinder> makeSplitAndMerge(const LaserLineOptions& options);

}  // namespace omnimapper::perception::lines
