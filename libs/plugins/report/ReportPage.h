#pragma once

#include <omnimapper/derived/Closures.h>
#include <omnimapper/derived/GridPicture.h>
#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/map/DenseTrajectory.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/View.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// Input of the report in addition to the view.
struct ReportInput {
  const mapper::View& view;
  const mapper::PluginContext& context;
  const derived::GridPicture* picture;  ///< null if the map is empty
  /// In the frame of LevelFrame, for drawing from above.
  const std::vector<map::StampedPose>& trajectory;
  const std::vector<derived::Closure>& closures;
  const std::vector<derived::ShapedLandmark>& landmarks;  ///< in the map's frame
  const std::vector<derived::ShapedLandmark>& drawn_landmarks;
  std::size_t max_rows;  ///< largest number of rows of the decision log
};

/// The whole page, which has no references to other files.
std::string drawReport(const ReportInput& input);

}  // namespace omnimapper::plugins
