#pragma once

#include <omnimapper/plugin/Association.h>

#include "ObjectModel.h"

namespace omnimapper::plugins {

struct ObjectLandmarksOptions : mapper::AssociationOptions {
  int confirm_after = 3;               ///< images in which an object was found before it is drawn
  double size_share = 0.15;            ///< [-] standard deviation of the middle of a box, as a share of its sides
  double min_overlap = 0.3;            ///< [-] share of points by which an object may be one of the map
  double merge_overlap = 0.5;          ///< [-] share of points by which two objects are one
  bool on_surfaces_only = false;       ///< whether what stands on no known surface stays a candidate
  int max_per_image = 50;              ///< objects of an image that are used, the largest
  int max_candidates = 300;            ///< objects that are not confirmed
  double look_every = 0.2;             ///< [s] between two images in which the objects of the map are looked for
  double look_range = 3.5;             ///< [m] beyond which an object is not looked for
  double look_inflation = 1;           ///< [-] of the pose's standard deviations before an object is called absent
  int gone_after = 3;                  ///< images from which an object is absent before it is gone
  double gone_after_time = 1;          ///< [s] that these images span at least
  double voxel = ModelLimits().voxel;  ///< [m] ModelLimits::voxel
  int max_points = ModelLimits().max_points;  ///< ModelLimits::max_points
  int max_views = ModelLimits().max_views;    ///< ModelLimits::max_views

  ModelLimits limits() const { return {voxel, max_points, max_views}; }
  static const base::OptionTable<ObjectLandmarksOptions>& table();
};

}  // namespace omnimapper::plugins
