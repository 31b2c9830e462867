#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/sim/LaserOptics.h>

namespace omnimapper::sim {

/// The table with the keys of LaserOpticsOptions after its own; Options derives from them.
template <class Options>
base::OptionTable<Options> withOptics(base::OptionTable<Options> table) {
  using base::Range;
  const Range positive = Range::positive(), zero_or_more = Range::notNegative(), part{0, 1};
  return table.number("min_range_m", &Options::min_range, zero_or_more, "Nearer things are not measured.")
      .number("max_range_m", &Options::max_range, positive, "Nor farther ones.")
      .number("white_range_m", &Options::white_range, zero_or_more,
              "Range at which a white wall can only just be measured; dark ones nearer. 0: all alike.")
      .number("divergence_deg", &Options::divergence, {0, 10}, "Full angle of a beam's cone; 0: a line.")
      .number("noise_m", &Options::noise, zero_or_more, "Standard deviation of ranges.")
      .number("noise_per_m", &Options::noise_per_metre, zero_or_more, "What each metre of range adds to it [m].")
      .number("step_m", &Options::step, zero_or_more, "Ranges are multiples of it; 0: not rounded.")
      .number("mixing_gap_m", &Options::mixing_gap, zero_or_more,
              "Two things in one beam are mixed up to this distance of one behind the other.")
      .number("mixing", &Options::mixing, part, "Part of such beams whose range is a mean of both.")
      .number("lost", &Options::lost, part, "Part of the echoes that are missed.")
      .number("glass_deg", &Options::glass_angle, zero_or_more,
              "Incidence up to which panes are seen themselves, one sigma; 0: never, and they never mirror.");
}

}  // namespace omnimapper::sim
