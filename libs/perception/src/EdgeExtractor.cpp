#include <mrpt/maps/CSimplePointsMap.h>
#include <omnimapper/camera/DepthScan.h>
#include <omnimapper/perception/EdgeExtractor.h>
#include <omnimapper/perception/viewOf.h>

#include <algorithm>
#include <cmath>

#include "edges/Canny.h"

namespace omnimapper::perception {

namespace {

// Counts the edge pixels of a picture in rectangles, by a summed-area table.
class EdgeSums {
 public:
  EdgeSums(edges::Candidates& found, const camera::ColourImage& picture)
      : width_(picture.width), height_(picture.height), stride_(static_cast<std::size_t>(width_) + 1) {
    sums_.resize(stride_ * (static_cast<std::size_t>(height_) + 1), 0);
    for (int y = 0; y < height_; ++y) {
      const std::uint8_t* row = found.row(y);
      int in_row = 0;
      for (int x = 0; x < width_; ++x) {
        in_row += row[x] == edges::Candidates::kKept;
        at(x + 1, y + 1) = at(x + 1, y) + in_row;
      }
    }
  }

  /// Whether an edge pixel is at most `half` columns and rows from the place.
  bool isNear(const camera::ScanColours::Place& place, int half) {
    const int left = std::max(0, place.x - half), right = std::min(width_, place.x + half + 1);
    const int top = std::max(0, place.y - half), bottom = std::min(height_, place.y + half + 1);
    return at(right, bottom) - at(left, bottom) > at(right, top) - at(left, top);
  }

 private:
  int& at(int x, int y) { return sums_[static_cast<std::size_t>(y) * stride_ + static_cast<std::size_t>(x)]; }

  int width_, height_;
  std::size_t stride_;
  std::vector<int> sums_;  // edge pixels to the left of and above each pixel corner
};

// Half of the width of a depth pixel in the picture, without the middle pixel [px]. It is limited to the size of the
// picture, since the colour camera's calibration may be anything.
int halfWidth(const camera::ScanColours& colours, const camera::ColourImage& picture) {
  const double half = 0.5 * colours.pixelsPerDepthPixel() - 0.5;
  return half > 0 ? static_cast<int>(std::lround(std::min<double>(half, std::max(picture.width, picture.height)))) : 0;
}

// Adds the edges of a picture whose pixels do not coincide with those of the depth image.
void addRgb(const camera::DepthImage& depth, const camera::ScanColours& colours, const EdgeOptions& options,
            EdgeImage& edges) {
  const camera::ColourImage picture = colours.picture();
  auto found = edges::canny(picture, static_cast<int>(options.rgb_low), static_cast<int>(options.rgb_high));
  EdgeSums sums(found, picture);
  const int half = halfWidth(colours, picture);
  std::size_t i = 0;
  for (int y = 0; y < edges.height; ++y) {
    for (int x = 0; x < edges.width; ++x, ++i) {
      const double z = depth.at(i);
      if (!(z >= options.min_depth && z <= options.max_depth)) continue;
      const auto place = colours.placeOf(x, y, z);
      if (place && sums.isNear(*place, half)) edges.labels[i] |= kRgb;
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

std::string labelOf(const mrpt::obs::CObservation3DRangeScan& scan, EdgeKind kind) {
  return scan.sensorLabel + kEdgesSuffix + nameOf(kind);
}

}  // namespace

std::vector<std::string> EdgeExtractor::labelsOf(const mrpt::obs::CObservation3DRangeScan& scan) const {
  std::vector<std::string> labels;
  for (const EdgeKind kind : wantedKinds(options_, camera::ScanColours(scan).exist()))
    labels.push_back(labelOf(scan, kind));
  return labels;
}

std::vector<mrpt::obs::CObservationPointCloud::Ptr> EdgeExtractor::cloudsOf(
    const mrpt::obs::CObservation3DRangeScan& scan, const camera::RgbdView& view) const {
  const camera::DepthImage& depth = view.depth();
  const camera::ScanColours& colours = view.colours();
  const bool same_view = options_.rgb && colours.areOfDepthView();
  EdgeImage edges = same_view ? detector_.detect(depth, colours.picture()) : detector_.detect(depth);
  if (options_.rgb && colours.exist() && !same_view) addRgb(depth, colours, options_, edges);
  std::vector<mrpt::obs::CObservationPointCloud::Ptr> clouds;
  for (const EdgeKind kind : wantedKinds(options_, colours.exist())) {
    const auto points = edgePoints(edges, depth, kind);
    auto cloud = mrpt::maps::CSimplePointsMap::Create();
    cloud->reserve(points.size());
    for (const auto& point : points) {
      const Eigen::Vector3f p = camera::toSensor(point);
      cloud->insertPointFast(p.x(), p.y(), p.z());
    }
    auto derived = mrpt::obs::CObservationPointCloud::Create();
    derived->pointcloud = cloud;
    derived->sensorPose = scan.sensorPose;
    derived->timestamp = scan.timestamp;
    derived->sensorLabel = labelOf(scan, kind);
    clouds.push_back(std::move(derived));
  }
  return clouds;
}

std::vector<mrpt::obs::CObservationPointCloud::Ptr> EdgeExtractor::extract(
    const mrpt::obs::CObservation3DRangeScan& scan) const {
  return cloudsOf(scan, camera::RgbdView(scan));
}

bool EdgeExtractor::wants(const mrpt::obs::CObservation& raw) const {
  return camera::depthScanOf(raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> EdgeExtractor::extract(const mrpt::obs::CObservation& raw) const {
  const auto clouds = extract(*camera::depthScanOf(raw));
  return {clouds.begin(), clouds.end()};
}

std::vector<mrpt::obs::CObservation::Ptr> EdgeExtractor::extractUsing(const mrpt::obs::CObservation& raw,
                                                                      Blackboard& board) const {
  const auto& scan = *camera::depthScanOf(raw);
  const auto clouds = cloudsOf(scan, viewOf(scan, board));
  return {clouds.begin(), clouds.end()};
}

std::vector<DerivedName> EdgeExtractor::namesOf(const mrpt::obs::CObservation& raw) const {
  std::vector<DerivedName> names;
  for (auto& label : labelsOf(*camera::depthScanOf(raw)))
    names.push_back({CLASS_ID(mrpt::obs::CObservationPointCloud), std::move(label)});
  return names;
}

}  // namespace omnimapper::perception
