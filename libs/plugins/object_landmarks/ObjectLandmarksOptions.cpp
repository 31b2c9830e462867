#include "ObjectLandmarksOptions.h"

namespace omnimapper::plugins {

const base::OptionTable<ObjectLandmarksOptions>& ObjectLandmarksOptions::table() {
  using Options = ObjectLandmarksOptions;
  using base::Range;
  static const auto table = [] {
    auto own =
        base::OptionTable<Options>()
            .integer("confirm_after", &Options::confirm_after, Range{1, 1000},
                     "Number of images in which an object must have been found before it is drawn. Until then it is a "
                     "candidate, so that what is carried, and parts of furniture that are found once, are not objects "
                     "of the map.")
            .number("size_share", &Options::size_share, Range{0.01, 1},
                    "Standard deviation of the middle of an object's box, as a share of the sides of the box, because "
                    "each view shows another part of the object.")
            .number("min_overlap", &Options::min_overlap, Range{0.01, 1},
                    "Smallest share of the points of an object, or of an object of the map, that must be near the "
                    "other's for both to be one.")
            .number(
                "merge_overlap", &Options::merge_overlap, Range{0.01, 1},
                "Two objects of the map are one if this share of the points of both lies near the other's, or of one "
                "if no image shows both.")
            .flag("on_surfaces_only", &Options::on_surfaces_only,
                  "Keeps objects as candidates at the end of a run that stand neither on a surface which their images "
                  "show "
                  "nor on a table or another surface of the map. With on_surfaces_only = false in the section of the "
                  "extractor, things on tables that images show only edge-on are found, too.")
            .integer("max_per_image", &Options::max_per_image, Range{1, 10000},
                     "Largest number of objects of an image that are used; the largest are taken.")
            .integer("max_candidates", &Options::max_candidates, Range{1, 1e6},
                     "Largest number of objects that have not been confirmed. Beyond it, the one that was not seen for "
                     "the longest time is given up for each new one.")
            .number("look_every_s", &Options::look_every, Range::notNegative(),
                    "Shortest time between two depth images in which the objects of the map are looked for.")
            .number("look_range_m", &Options::look_range, Range::positive(),
                    "Largest depth at which an object is looked for.")
            .number("look_inflation", &Options::look_inflation, Range{1, 100},
                    "An object is called absent only if the pose of the camera cannot explain it with standard "
                    "deviations that are this many times those which the map predicts.")
            .integer("gone_after", &Options::gone_after, Range{1, 20},
                     "An object that was absent from this many images since it was last seen is gone.")
            .number("gone_after_s", &Options::gone_after_time, Range::notNegative(),
                    "These images must span at least this time.")
            .number("voxel_m", &Options::voxel, Range{0.001, 0.1},
                    "Points of a model that are nearer to one another than this are one.")
            .integer("max_points", &Options::max_points, Range{10, 1e6}, "Largest number of points of a model.")
            .integer("max_views", &Options::max_views, Range{1, 1000},
                     "Largest number of key frames whose points a model keeps; the nearest are kept.");
    return declareIn(own);
  }();
  return table;
}

}  // namespace omnimapper::plugins
