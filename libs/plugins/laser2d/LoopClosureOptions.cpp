#include "LoopClosureOptions.h"

namespace omnimapper::plugins {

const base::OptionTable<LoopClosureOptions>& LoopClosureOptions::table() {
  using Options = LoopClosureOptions;
  static const auto table =
      base::OptionTable<Options>()
          .list("labels", &Options::labels, "Labels of the clouds to match; empty for all made from 2D scans.")
          .number("radius_m", &Options::radius, base::Range::positive(),
                  "Places so far from where the base may be are tried.")
          .number("min_travel_m", &Options::min_travel, base::Range::positive(),
                  "Places left less than this way ago are no loop.")
          .number(
              "spacing_m", &Options::spacing, base::Range::notNegative(),
              "Way between the key frames that search: closures side by side tell the same, and make solves dearer.")
          .integer("candidates", &Options::candidates, base::Range{1, 1000}, "Places tried per key frame.")
          .number(
              "submap_length_m", &Options::context, base::Range::positive(),
              "Way before a key frame whose scans are sought together, in a local map of twice that before and after "
              "a place; both are longer by as much as the estimate may be off.")
          .number("max_window_m", &Options::max_window, base::Range::positive(),
                  "However uncertain the estimate is, a place is sought no farther from it.")
          .number("max_window_deg", &Options::max_window_angle, base::Range{0, 180},
                  "However uncertain the estimate is, a heading is sought no farther from it.")
          .number(
              "lost_travel_m", &Options::lost_travel, base::Range::notNegative(),
              "Without a closure on this way the last metres are sought in all that was seen before, as far as what "
              "is seen does not fit the map there; a session that continues a map and was not joined, in all of "
              "that, at once if its start is vaguer than the windows.")
          .number("join_travel_m", &Options::join_travel, base::Range::notNegative(),
                  "Where much of the map is alike, what was seen on this way must fit where such a search finds it.")
          .number("known_sigma_m", &Options::known_sigma, base::Range::notNegative(),
                  "Where the estimate is as good as this and the next, no closure is sought: it would tell little.")
          .number("known_sigma_deg", &Options::known_angle_sigma, base::Range::notNegative(),
                  "The same of the heading.")
          .number("min_overlap", &Options::min_overlap, base::Range{0, 1},
                  "Share of the points that must find a partner.")
          .number("max_sigma_m", &Options::max_sigma, base::Range::positive(),
                  "A match that the walls fix less well in some direction is no closure.")
          .number("point_sigma_m", &Options::point_sigma, base::Range::positive(),
                  "Standard deviation of a point from the wall it lies on.")
          .number("wall_sigma_factor", &Options::wall_sigma_factor, base::Range::notNegative(),
                  "The same as a multiple of the distance that the points of a match have from the walls; the larger "
                  "counts.")
          .number("position_sigma_floor_m", &Options::position_sigma_floor, base::Range::positive(),
                  "No closure is trusted more than this: its local map is as bent as the trajectory was then.")
          .number("angle_sigma_floor_deg", &Options::angle_sigma_floor, base::Range::positive(),
                  "No closure is trusted more than this.")
          .number("loss_scale", &Options::loss_scale, base::Range::positive(),
                  "Scale of the Cauchy loss on closures, in standard deviations.");
  return table;
}

}  // namespace omnimapper::plugins
