#include "ScanDatabase.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/grid/ScanBeams.h>
#include <omnimapper/perception/LaserPointsExtractor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "PlanarMotion.h"

namespace omnimapper::plugins {

using mrpt::math::TPose2D;

ScanDatabase::ScanDatabase(const map::Map& map,
                           const std::map<std::string, std::vector<LoopSearch::KeyScan>>& key_scans,
                           std::shared_ptr<const matching::ScanMatcher> matcher,
                           const matching::RelocalizerOptions& options)
    : matcher_(std::move(matcher)), options_(options), anywhere_(mapper::startAnywhere(map)) {
  options_.poor = -std::numeric_limits<double>::infinity();  // no second, wider search: better scans will follow
  const auto isAligned = [&](const LoopSearch::KeyScan& key_scan) {
    return std::any_of(map.sessions.begin(), map.sessions.end(), [&](const map::Session& session) {
      return session.number == key_scan.frame.session && session.aligned;
    });
  };
  for (const auto& [label, all] : key_scans) {
    for (const auto& key_scan : all) {
      if (key_scan.scan->empty() || !isAligned(key_scan)) continue;
      labels_.push_back(label);
      frames_.push_back(map.keyFrame(key_scan.frame));
      places_.push_back({key_scan, planar(frames_.back().map_from_base)});
    }
  }
}

std::vector<ScanDatabase::Place> ScanDatabase::nearest(const TPose2D& map_from_base, std::size_t count) const {
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    near.emplace_back(distanceBetween(places_[i].map_from_base, map_from_base).ofViews(), i);
  }
  count = std::min(count, near.size());
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
  std::vector<Place> nearest;
  for (std::size_t k = 0; k < count; ++k) nearest.push_back(places_[near[k].second]);
  return nearest;
}

void ScanDatabase::makeRelocalizer() const {
  std::call_once(once_, [this] {
    std::vector<matching::MapScan> scans;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      auto beams = beamsInBase(frames_[i], labels_[i]);
      scans.push_back({places_[i].map_from_base + beams.local_from_sensor, std::move(beams.scan)});
    }
    try {
      relocalizer_ = std::make_unique<const matching::Relocalizer>(std::move(scans), matcher_, options_);
    } catch (const base::Error& error) {
      too_large_ = error.what();  // an exception out of call_once would make every later caller try again
    }
  });
}

bool ScanDatabase::hasRelocalizer() const {
  makeRelocalizer();
  return relocalizer_ != nullptr;
}

const matching::Relocalizer& ScanDatabase::relocalizer() const {
  makeRelocalizer();
  if (!relocalizer_) throw base::Error(base::ExitCode::out_of_range, too_large_);
  return *relocalizer_;
}

namespace {

// A hit beyond kLongest only shows free space up to there. Beams without echo are left out, because dark walls give
// none either.
matching::LocalScan beamsOf(const mrpt::obs::CObservation2DRangeScan& scan) {
  constexpr double kLongest = 25;  // [m]
  const grid::BeamEnds beams(scan, {}, grid::BeamEnds::Pose::of_base);
  const auto origin = beams.origin();
  matching::LocalScan local{{origin.x, origin.y, 0}, {}};
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (!beams.hits(i)) continue;
    const auto end = beams.at(i, kLongest) - origin;
    (beams.range(i) < kLongest ? local.scan.hits : local.scan.misses).emplace_back(end.x, end.y);
  }
  return local;
}

matching::LocalScan localScanOf(const mrpt::obs::CObservationPointCloud& cloud) {
  const auto rotation = cloud.sensorPose.getRotationMatrix().asEigen();
  matching::LocalScan local{{cloud.sensorPose.x(), cloud.sensorPose.y(), 0}, {}};
  for (std::size_t i = 0; i < cloud.pointcloud->size(); ++i) {
    float x, y, z;
    cloud.pointcloud->getPointFast(i, x, y, z);
    local.scan.hits.emplace_back(rotation(0, 0) * x + rotation(0, 1) * y + rotation(0, 2) * z,
                                 rotation(1, 0) * x + rotation(1, 1) * y + rotation(1, 2) * z);
  }
  return local;
}

}  // namespace

matching::LocalScan beamsInBase(const map::KeyFrame& frame, const std::string& cloud_label) {
  const mrpt::obs::CObservationPointCloud* cloud = nullptr;
  for (const auto& observation : frame.observations) {
    const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(observation.get());
    if (scan && perception::LaserPointsExtractor::labelOf(scan->sensorLabel) == cloud_label) return beamsOf(*scan);
    if (observation->sensorLabel != cloud_label) continue;
    if (const auto* points = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(observation.get())) cloud = points;
  }
  return cloud ? localScanOf(*cloud) : matching::LocalScan();
}

}  // namespace omnimapper::plugins
