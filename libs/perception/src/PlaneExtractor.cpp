#include <omnimapper/base/Error.h>
#include <omnimapper/camera/DepthScan.h>
#include <omnimapper/camera/RangeScan.h>
#include <omnimapper/perception/PlaneExtractor.h>

#include "planes/PlaneObservation.h"

namespace omnimapper::perception {

const base::OptionTable<OutlineOptions>& OutlineOptions::table() {
  static const auto table = base::OptionTable<OutlineOptions>().number(
      "outline_tolerance_px", &OutlineOptions::tolerance, base::Range::notNegative(),
      "Outlines are simplified: a corner nearer than this to the line through the remaining corners is left out; "
      "0 keeps all corners.");
  return table;
}

std::shared_ptr<obs::CObservationPlanes> PlaneExtractor::extract(const mrpt::obs::CObservation3DRangeScan& scan) const {
  const camera::ScanDepth depth(scan);
  const camera::ScanColours colours(scan);
  if (!segmenter_.needsColours())
    return planes::observe(segmenter_.segment(depth.image()), scan, depth, colours, outlines_.tolerance);
  if (!colours.exist()) {
    throw base::Error(base::ExitCode::unreadable_input,
                      scan.sensorLabel +
                          ": its scans have no picture with 8 bits per channel, but the comparator of planes needs "
                          "colours; comparator = plane does without them");
  }
  return planes::observe(segmenter_.segment(depth.image(), colours.inDepthView(depth)), scan, depth, colours,
                         outlines_.tolerance);
}

bool PlaneExtractor::wants(const mrpt::obs::CObservation& raw) const {
  return camera::depthScanOf(raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> PlaneExtractor::extract(const mrpt::obs::CObservation& raw) const {
  return {extract(*camera::depthScanOf(raw))};
}

std::vector<DerivedName> PlaneExtractor::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(obs::CObservationPlanes), raw.sensorLabel + kPlanesSuffix}};
}

}  // namespace omnimapper::perception
