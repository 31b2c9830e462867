#include "UsableScan.h"

#include <omnimapper/grid/ScanBeams.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>

namespace omnimapper::plugins {

bool haveSameRanges(const mrpt::obs::CObservation2DRangeScan& a, const mrpt::obs::CObservation2DRangeScan& b) {
  constexpr std::size_t kFewEchoes = 10;
  const std::size_t beams = a.getScanSize();
  if (b.getScanSize() != beams) return false;
  std::size_t echoes = 0;
  const auto isEcho = [](const mrpt::obs::CObservation2DRangeScan& scan, std::size_t i) {
    return scan.getScanRangeValidity(i) && std::isfinite(scan.getScanRange(i)) && scan.getScanRange(i) < scan.maxRange;
  };
  for (std::size_t i = 0; i < beams; ++i) {
    if (isEcho(a, i) != isEcho(b, i)) return false;
    if (!isEcho(a, i)) continue;
    if (a.getScanRange(i) != b.getScanRange(i)) return false;
    ++echoes;
  }
  return echoes >= kFewEchoes;
}

mrpt::obs::CObservation2DRangeScan::Ptr withoutBeamsNear(const std::vector<Eigen::Vector2f>& points, float near,
                                                         const mrpt::obs::CObservation2DRangeScan& scan) {
  auto usable = std::make_shared<mrpt::obs::CObservation2DRangeScan>(scan);
  const grid::BeamEnds beams(scan, {}, grid::BeamEnds::Pose::of_base);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (!beams.hits(i)) continue;
    const auto end = beams.at(i, scan.maxRange);
    const Eigen::Vector2f place(static_cast<float>(end.x), static_cast<float>(end.y));
    const bool is_near = std::any_of(points.begin(), points.end(), [&](const Eigen::Vector2f& point) {
      return (point - place).squaredNorm() < near * near;
    });
    if (is_near) usable->setScanRangeValidity(i, false);
  }
  return usable;
}

}  // namespace omnimapper::plugins
