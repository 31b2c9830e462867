#include "UsableScan.h"

#include <omnimapper/grid/ScanBeams.h>

#include <algorithm>
#include <cstddef>
#include <memory>

namespace omnimapper::plugins {

bool haveSameRanges(const mrpt::obs::CObservation2DRangeScan& a, const mrpt::obs::CObservation2DRangeScan& b) {
  constexpr std::size_t kFewEchoes = 10;
  const std::size_t beams = a.getScanSize();
  if (b.getScanSize() != beams) return false;
  std::size_t echoes = 0;
  for (std::size_t i = 0; i < beams; ++i) {
    if (a.getScanRange(i) != b.getScanRange(i)) return false;
    echoes += a.getScanRangeValidity(i) && a.getScanRange(i) < a.maxRange;
  }
  return echoes >= kFewEchoes;
}

mrpt::obs::CObservation2DRangeScan::Ptr withoutBeamsNear(const std::vector<Eigen::Vector2f>& points,
                                                         const mrpt::obs::CObservation2DRangeScan& scan) {
  constexpr float kNear = 0.09F;  // [m] more than the distance between the points that an extractor keeps
  auto usable = std::make_shared<mrpt::obs::CObservation2DRangeScan>(scan);
  const grid::BeamEnds beams(scan, {}, grid::BeamEnds::Pose::of_base);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (!beams.hits(i)) continue;
    const auto end = beams.at(i, scan.maxRange);
    const Eigen::Vector2f place(static_cast<float>(end.x), static_cast<float>(end.y));
    const bool is_near = std::any_of(points.begin(), points.end(), [&](const Eigen::Vector2f& point) {
      return (point - place).squaredNorm() < kNear * kNear;
    });
    if (is_near) usable->setScanRangeValidity(i, false);
  }
  return usable;
}

}  // namespace omnimapper::plugins
