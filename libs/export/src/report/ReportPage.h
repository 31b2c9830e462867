#pragma once

#include <omnimapper/map/DenseTrajectory.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/View.h>

#include <string>
#include <vector>

#include "grid/GridPicture.h"
#include "plan/LandmarkShapes.h"
#include "run/Closures.h"

namespace omnimapper::exports {

/// What the report shows beside the view itself.
struct ReportInput {
  const mapper::View& view;
  const mapper::PluginContext& context;
  const GridPicture* picture;  ///< null for a map that is empty
  /// From above, as LevelFrame turns them.
  const std::vector<map::StampedPose>& trajectory;
  const std::vector<Closure>& closures;
  const std::vector<ShapedLandmark>& landmarks;  ///< in the map
  const std::vector<ShapedLandmark>& drawn_landmarks;
  std::size_t max_rows;  ///< of the decision log
};

/// The whole page, which refers to nothing outside of it.
std::string drawReport(const ReportInput& input);

}  // namespace omnimapper::exports
