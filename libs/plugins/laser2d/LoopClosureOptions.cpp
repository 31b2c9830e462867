#include "LoopClosureOptions.h"

namespace omnimapper::plugins {

const base::OptionTable<LoopClosureOptions>& LoopClosureOptions::table() {
  using Options = LoopClosureOptions;
  static const auto table =
      base::OptionTable<Options>()
          .list("labels", &Options::labels,
                "Sensor labels of the clouds that are matched; empty for all clouds that are made from 2D scans.")
          .number("radius_m", &Options::radius, base::Range::positive(),
                  "An earlier place is tried for a loop closure if it is no farther from the estimated position than "
                  "this plus three standard deviations of that position.")
          .number("min_travel_m", &Options::min_travel, base::Range::positive(),
                  "A return to a place counts as a loop only if the robot has travelled at least this far since it "
                  "left the place.")
          .number("spacing_m", &Options::spacing, base::Range::notNegative(),
                  "Distance travelled between the key frames that search for loop closures; closures side by side add "
                  "little information and make solves slower.")
          .integer("candidates", &Options::candidates, base::Range{1, 1000},
                   "Largest number of places tried for a loop closure per key frame.")
          .number("submap_length_m", &Options::context, base::Range::positive(),
                  "Length of the last part of the trajectory. The scans of this part are merged and matched with a "
                  "local map of an earlier place. The local map has the scans from twice this length before the place "
                  "to twice this length after it. Both lengths grow with the uncertainty of the estimate.")
          .number("max_window_m", &Options::max_window, base::Range::positive(),
                  "Largest distance from the estimated position at which a loop closure is searched for, however "
                  "uncertain the estimate is.")
          .number("max_window_deg", &Options::max_window_angle, base::Range{0, 180},
                  "Largest deviation from the estimated heading at which a loop closure is searched for, however "
                  "uncertain the estimate is.")
          .number("lost_travel_m", &Options::lost_travel, base::Range::notNegative(),
                  "Distance travelled without a loop closure after which the whole earlier map is searched if the "
                  "newest scan does not fit the map at the estimated pose. A session whose place in the saved map is "
                  "not known yet searches the saved map after this distance, or at once if its position may be off by "
                  "more than max_window_m.")
          .number("join_travel_m", &Options::join_travel, base::Range::notNegative(),
                  "If much of the map looks alike, a place that was found by a search of the whole map is accepted "
                  "only if all scans of the last part of the trajectory, of this length, fit there.")
          .number("known_sigma_m", &Options::known_sigma, base::Range::notNegative(),
                  "A loop closure with a place is not tried if the relative position has a smaller standard deviation "
                  "than this and the relative heading a smaller one than known_sigma_deg, because the closure would "
                  "add little information.")
          .number("known_sigma_deg", &Options::known_angle_sigma, base::Range::notNegative(),
                  "A loop closure with a place is not tried if the relative heading has a smaller standard deviation "
                  "than this and the relative position a smaller one than known_sigma_m, because the closure would add "
                  "little information.")
          .number("min_overlap", &Options::min_overlap, base::Range{0, 1},
                  "A match becomes a loop closure only if at least this share of its points have a corresponding point "
                  "in the map.")
          .number("max_sigma_m", &Options::max_sigma, base::Range::positive(),
                  "A match becomes a loop closure only if its position has at most this standard deviation in the "
                  "direction that the walls constrain least.")
          .number("point_sigma_m", &Options::point_sigma, base::Range::positive(),
                  "Smallest standard deviation that is assumed for the distance of a point from the wall it lies on.")
          .number("wall_sigma_factor", &Options::wall_sigma_factor, base::Range::notNegative(),
                  "The standard deviation of a point is this number times the root mean square distance of the matched "
                  "points from the walls, but at least point_sigma_m.")
          .number("position_sigma_floor_m", &Options::position_sigma_floor, base::Range::positive(),
                  "Smallest standard deviation of a loop closure's position, however exact the match is, because the "
                  "matched local map may be distorted.")
          .number("angle_sigma_floor_deg", &Options::angle_sigma_floor, base::Range::positive(),
                  "Smallest standard deviation of a loop closure's heading, however exact the match is.")
          .number("loss_scale", &Options::loss_scale, base::Range::positive(),
                  "Number of standard deviations beyond which a loop closure that disagrees loses influence (scale of "
                  "the Cauchy loss).");
  return table;
}

}  // namespace omnimapper::plugins
