#include <mrpt/maps/CSimplePointsMap.h>
#include <omnimapper/perception/EdgeExtractor.h>

#include <algorithm>
#include <cmath>

#include "RangeScan.h"
#include "edges/Canny.h"

namespace omnimapper::perception {

namespace {

// Whether there is an edge of the picture in what a pixel of the depth image covers of it.
bool seesEdge(edges::Candidates& found, const ColourImage& picture, const ScanColours::Place& place, int half) {
  for (int y = std::max(0, place.y - half); y <= std::min(picture.height - 1, place.y + half); ++y) {
    const std::uint8_t* row = found.row(y);
    for (int x = std::max(0, place.x - half); x <= std::min(picture.width - 1, place.x + half); ++x) {
      if (row[x] == edges::Candidates::kKept) return true;
    }
  }
  return false;
}

// Of a picture of another view.
void addRgb(const ScanDepth& depth, const ScanColours& colours, const EdgeOptions& options, EdgeImage& edges) {
  const ColourImage picture = colours.picture();
  auto found = edges::canny(picture, static_cast<int>(options.rgb_low), static_cast<int>(options.rgb_high));
  const int half = static_cast<int>(std::lround(0.5 * colours.pixelsPerDepthPixel() - 0.5));
  std::size_t i = 0;
  for (int y = 0; y < edges.height; ++y) {
    for (int x = 0; x < edges.width; ++x, ++i) {
      const double z = depth.at(i);
      if (!(z >= options.min_depth && z <= options.max_depth)) continue;
      const auto place = colours.placeOf(x, y, z);
      if (place && seesEdge(found, picture, *place, half)) edges.labels[i] |= kRgb;
    }
  }
}

std::vector<EdgeKind> wantedKinds(const EdgeOptions& options, bool picture) {
  std::vector<EdgeKind> kinds;
  if (options.jumps) kinds = {kBoundary, kOccluding, kOccluded};
  if (options.high_curvature) kinds.push_back(kHighCurvature);
  if (options.rgb && picture) kinds.push_back(kRgb);
  return kinds;
}

}  // namespace

std::vector<mrpt::obs::CObservationPointCloud::Ptr> EdgeExtractor::extract(
    const mrpt::obs::CObservation3DRangeScan& scan) const {
  const ScanDepth depth(scan);
  const ScanColours colours(scan);
  const bool same_view = options_.rgb && colours.areOfDepthView();
  EdgeImage edges = same_view ? detector_.detect(depth.image(), colours.picture()) : detector_.detect(depth.image());
  if (options_.rgb && colours.exist() && !same_view) addRgb(depth, colours, options_, edges);
  std::vector<mrpt::obs::CObservationPointCloud::Ptr> clouds;
  for (const EdgeKind kind : wantedKinds(options_, colours.exist())) {
    const auto points = edgePoints(edges, depth.image(), kind);
    auto cloud = mrpt::maps::CSimplePointsMap::Create();
    cloud->reserve(points.size());
    for (const auto& p : points) cloud->insertPointFast(p.z(), -p.x(), -p.y());
    auto derived = mrpt::obs::CObservationPointCloud::Create();
    derived->pointcloud = cloud;
    derived->sensorPose = scan.sensorPose;
    derived->timestamp = scan.timestamp;
    derived->sensorLabel = scan.sensorLabel + kEdgesSuffix + nameOf(kind);
    clouds.push_back(std::move(derived));
  }
  return clouds;
}

}  // namespace omnimapper::perception
