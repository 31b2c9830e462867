#include "LoopClosureOptions.h"

namespace omnimapper::plugins {

const base::OptionTable<LoopClosureOptions>& LoopClosureOptions::table() {
  using Options = LoopClosureOptions;
  static const auto table =
      base::OptionTable<Options>()
          .list("labels", &Options::labels, "Labels of the clouds to match; empty for all clouds made from 2D scans.")
          .number("radius_m", &Options::radius, base::Range::positive(),
                  "A loop closure with a place is tried if the place is no farther from the estimated position than "
                  "this plus the uncertainty of the position.")
          .number("min_travel_m", &Options::min_travel, base::Range::positive(),
                  "A return to a place counts as a loop only if the robot has travelled at least this far since it "
                  "left the place.")
          .number("spacing_m", &Options::spacing, base::Range::notNegative(),
                  "Distance travelled between the key frames that search for loop closures; closures side by side add "
                  "little information and make solves slower.")
          .integer("candidates", &Options::candidates, base::Range{1, 1000},
                   "Largest number of places tried for a loop closure per key frame.")
          .number("submap_length_m", &Options::context, base::Range::positive(),
                  "Length of the last part of the trajectory whose scans are matched together. They are matched with a "
                  "local map of an earlier place, which has the scans of twice this distance before and after it. Both "
                  "lengths grow with the uncertainty of the estimate.")
          .number("max_window_m", &Options::max_window, base::Range::positive(),
                  "Largest distance from the estimated position at which a loop closure is searched for, however "
                  "uncertain the estimate is.")
          .number("max_window_deg", &Options::max_window_angle, base::Range{0, 180},
                  "Largest deviation from the estimated heading at which a loop closure is searched for, however "
                  "uncertain the estimate is.")
          .number("lost_travel_m", &Options::lost_travel, base::Range::notNegative(),
                  "Distance travelled without a closure after which the whole earlier map is searched, if the scans do "
                  "not fit the map at the estimated pose. A session that is not aligned searches the saved map after "
                  "this distance, or at once if the pose of its start is more uncertain than max_window_m.")
          .number("join_travel_m", &Options::join_travel, base::Range::notNegative(),
                  "Distance travelled over which all scans must fit the place found by a global search, where much "
                  "of the map looks alike.")
          .number(
              "known_sigma_m", &Options::known_sigma, base::Range::notNegative(),
              "No closure is searched for if the position relative to the place has a smaller standard deviation than "
              "this, and the heading a smaller one than known_sigma_deg, because it would add little information.")
          .number(
              "known_sigma_deg", &Options::known_angle_sigma, base::Range::notNegative(),
              "No closure is searched for if the heading relative to the place has a smaller standard deviation than "
              "this, and the position a smaller one than known_sigma_m, because it would add little information.")
          .number("min_overlap", &Options::min_overlap, base::Range{0, 1},
                  "Smallest share of the points of a match that must have a correspondence.")
          .number("max_sigma_m", &Options::max_sigma, base::Range::positive(),
                  "Largest standard deviation of a match, in the direction that the walls constrain least, for a "
                  "loop closure.")
          .number("point_sigma_m", &Options::point_sigma, base::Range::positive(),
                  "Standard deviation of the distance of a point from the wall it lies on.")
          .number("wall_sigma_factor", &Options::wall_sigma_factor, base::Range::notNegative(),
                  "Factor on the root mean square distance of the matched points from the walls. The larger one of the "
                  "product and point_sigma_m is the standard deviation of a point.")
          .number("position_sigma_floor_m", &Options::position_sigma_floor, base::Range::positive(),
                  "Smallest standard deviation of the position of a loop closure, because its local map is as "
                  "distorted as the trajectory was when it was matched.")
          .number("angle_sigma_floor_deg", &Options::angle_sigma_floor, base::Range::positive(),
                  "Smallest standard deviation of the heading of a loop closure.")
          .number("loss_scale", &Options::loss_scale, base::Range::positive(),
                  "Number of standard deviations beyond which a loop closure that disagrees loses influence (scale of "
                  "the Cauchy loss).");
  return table;
}

}  // namespace omnimapper::plugins
