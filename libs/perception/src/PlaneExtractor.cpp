#include <omnimapper/base/Error.h>
#include <omnimapper/camera/DepthScan.h>
#include <omnimapper/perception/PlaneExtractor.h>
#include <omnimapper/perception/viewOf.h>

#include "planes/FoundPlanes.h"
#include "planes/PlaneObservation.h"

namespace omnimapper::perception {

const base::OptionTable<OutlineOptions>& OutlineOptions::table() {
  static const auto table = base::OptionTable<OutlineOptions>().number(
      "outline_tolerance_px", &OutlineOptions::tolerance, base::Range::notNegative(),
      "Outlines are simplified: a corner nearer than this to the line through the remaining corners is left out; "
      "0 keeps all corners.");
  return table;
}

PlaneSegmentation PlaneExtractor::planesIn(const mrpt::obs::CObservation3DRangeScan& scan,
                                           const camera::RgbdView& view) const {
  if (!segmenter_.needsColours()) return segmenter_.segment(view.depth());
  if (view.colours().exist()) return segmenter_.segment(view.depth(), view.coloursOfDepths());
  throw base::Error(base::ExitCode::unreadable_input,
                    scan.sensorLabel +
                        ": its scans have no picture with 8 bits per channel, but the comparator of planes needs "
                        "colours; comparator = plane does without them");
}

std::shared_ptr<obs::CObservationPlanes> PlaneExtractor::extract(const mrpt::obs::CObservation3DRangeScan& scan) const {
  const camera::RgbdView view(scan);
  return planes::observe(planesIn(scan, view), scan, view, settings_.outlines.tolerance);
}

bool PlaneExtractor::wants(const mrpt::obs::CObservation& raw) const {
  return camera::depthScanOf(raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> PlaneExtractor::extract(const mrpt::obs::CObservation& raw) const {
  return {extract(*camera::depthScanOf(raw))};
}

std::vector<mrpt::obs::CObservation::Ptr> PlaneExtractor::extractUsing(const mrpt::obs::CObservation& raw,
                                                                       Blackboard& board) const {
  using planes::FoundPlanes;
  if (board.find<FoundPlanes>([&](const auto& one) { return one.settings == settings_; })) return {};
  const auto& scan = *camera::depthScanOf(raw);
  const camera::RgbdView& view = viewOf(scan, board);
  const auto found = std::make_shared<const FoundPlanes>(FoundPlanes{settings_, planesIn(scan, view)});
  board.put(found);
  return {planes::observe(found->planes, scan, view, settings_.outlines.tolerance)};
}

std::vector<DerivedName> PlaneExtractor::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(obs::CObservationPlanes), raw.sensorLabel + kPlanesSuffix}};
}

}  // namespace omnimapper::perception
