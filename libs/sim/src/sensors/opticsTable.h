#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/sim/LaserOptics.h>

namespace omnimapper::sim {

/// The table with the keys of LaserOpticsOptions after its own; Options derives from them.
template <class Options>
base::OptionTable<Options> withOptics(base::OptionTable<Options> table) {
  using base::Range;
  const Range positive = Range::positive(), zero_or_more = Range::notNegative(), part{0, 1};
  return table.number("min_range_m", &Options::min_range, zero_or_more, "Shortest range that the laser measures.")
      .number("max_range_m", &Options::max_range, positive, "Longest range that the laser measures.")
      .number("white_range_m", &Options::white_range, zero_or_more,
              "Range at which a white wall can only just be measured, while darker surfaces must be nearer. With 0 the "
              "range does not depend on brightness.")
      .number("divergence_deg", &Options::divergence, {0, 10},
              "Full angle of the cone of a beam. 0 makes the beam a line.")
      .number("noise_m", &Options::noise, zero_or_more, "Constant part of the standard deviation of a range.")
      .number("noise_per_m", &Options::noise_per_metre, zero_or_more,
              "Increase of the standard deviation of a range with each metre of range [m].")
      .number("step_m", &Options::step, zero_or_more,
              "Resolution of the ranges, which are rounded to multiples of it. 0 means that they are not rounded.")
      .number("mixing_gap_m", &Options::mixing_gap, zero_or_more,
              "Largest distance in range between two surfaces in one beam that are mixed into one range.")
      .number("mixing", &Options::mixing, part,
              "Fraction of the beams on two surfaces within mixing_gap_m that report a mean of both ranges.")
      .number("lost", &Options::lost, part, "Fraction of the echoes that are missed.")
      .number("glass_deg", &Options::glass_angle, zero_or_more,
              "Angle of incidence up to which glass panes themselves are measured, as one sigma. With 0 they are never "
              "measured and never mirror a beam.");
}

}  // namespace omnimapper::sim
