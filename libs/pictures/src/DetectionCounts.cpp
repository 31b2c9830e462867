#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/obs/CObservationDoorSigns.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/CObservationObjects.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/pictures/DetectionCounts.h>

#include <utility>

namespace omnimapper::pictures {

namespace {

std::pair<std::string, std::size_t> countOf(const mrpt::obs::CObservation& derived) {
  if (const auto* planes = dynamic_cast<const obs::CObservationPlanes*>(&derived))
    return {"planes", planes->planes.size()};
  if (const auto* lines = dynamic_cast<const obs::CObservationLaserLines*>(&derived))
    return {"lines", lines->lines.size()};
  if (const auto* objects = dynamic_cast<const obs::CObservationObjects*>(&derived))
    return {"objects", objects->objects.size()};
  if (const auto* signs = dynamic_cast<const obs::CObservationDoorSigns*>(&derived))
    return {"signs", signs->signs.size()};
  if (const auto* markers = dynamic_cast<const mrpt::obs::CObservationBearingRange*>(&derived))
    return {"markers", markers->sensedData.size()};
  if (const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&derived))
    return {"points", cloud->pointcloud ? cloud->pointcloud->size() : 0};
  return {};
}

}  // namespace

void DetectionCounts::add(const std::vector<mrpt::obs::CObservation::Ptr>& derived) {
  for (const auto& observation : derived) {
    auto [what, found] = countOf(*observation);
    Count& count = of_label_[observation->sensorLabel];
    count.what = std::move(what);
    ++count.observations;
    count.found += found;
  }
}

std::string DetectionCounts::text() const {
  std::string text;
  for (const auto& [label, count] : of_label_) {
    text += "  " + label + ": ";
    if (!count.what.empty()) text += std::to_string(count.found) + " " + count.what + " in ";
    text += base::counted(count.observations, "observation") + "\n";
  }
  return text;
}

}  // namespace omnimapper::pictures
