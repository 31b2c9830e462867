#include "PlaneLandmarksOptions.h"

namespace omnimapper::plugins {

const base::OptionTable<PlaneLandmarksOptions>& PlaneLandmarksOptions::table() {
  using Options = PlaneLandmarksOptions;
  using base::Range;
  static const auto table = [] {
    auto own =
        base::OptionTable<Options>()
            .choice("form", &Options::form, {{"plane", Options::Form::plane}, {"wall", Options::Form::wall}},
                    "Kind of landmarks. plane: planes in space. wall: walls as lines on the floor of a planar map, "
                    "measured only by the lines of level lasers.")
            .choice("ground", &Options::ground, {{"start", Options::Ground::start}, {"map", Options::Ground::map}},
                    "Height of the floor, above which a level surface can be a table. start: the height of the base at "
                    "the first key frame. map: z = 0 of the map, for a camera on given poses.")
            .choice("boundary", &Options::boundary,
                    {{"hull", Options::Boundary::hull}, {"seen", Options::Boundary::seen}},
                    "Boundary of a surface in the map. seen: the union of the observed parts, with bays and holes. "
                    "hull: the convex hull of the observed parts.")
            .flag("planes", &Options::planes, "Uses the planes of depth images and clouds.")
            .flag("lines", &Options::lines, "Uses the lines of 2D lasers.")
            .number("min_area_m2", &Options::min_area, Range::notNegative(),
                    "Smallest area of a plane measurement that creates a new landmark.")
            .number("min_length_m", &Options::min_length, Range::notNegative(),
                    "Smallest length of a line measurement that creates a new landmark.")
            .number("max_gap_m", &Options::max_gap, Range::notNegative(),
                    "Largest gap between parts of a wall that belong to one landmark, for laser lines and for surfaces "
                    "that reach higher than 1.5 m above the ground.")
            .number("max_plane_gap_m", &Options::max_plane_gap, Range::notNegative(),
                    "Largest gap between parts of a plane that belong to one landmark, for surfaces that reach no "
                    "higher than 1.5 m above the ground.")
            .number("well_seen_within_m", &Options::well_seen_within, Range::positive(),
                    "Parts of a surface that were measured from farther away than this are drawn only if no part of "
                    "the surface was measured better.")
            .number("well_seen_under_deg", &Options::well_seen_under, Range::positive(),
                    "Parts of a surface that were measured at a larger angle than this between ray and normal are "
                    "drawn only if no part of the surface was measured better.")
            .number("plane_sigma_m", &Options::plane_sigma, Range::notNegative(),
                    "Standard deviation by which a surface deviates from a plane, in addition to the noise that a "
                    "plane measurement reports.")
            .number("plane_angle_sigma_deg", &Options::plane_angle_sigma, Range::notNegative(),
                    "Standard deviation of the normal of a surface, in addition to the noise that a plane "
                    "measurement reports.")
            .number("line_sigma_m", &Options::line_sigma, Range::notNegative(),
                    "Standard deviation by which a wall deviates from a straight line, in addition to the noise that a "
                    "line measurement reports.")
            .number("line_angle_sigma_deg", &Options::line_angle_sigma, Range::notNegative(),
                    "Standard deviation of the direction of a wall, in addition to the noise that a line "
                    "measurement reports.")
            .number("upright_sigma_deg", &Options::upright_sigma, Range::positive(),
                    "Standard deviation of the tilt from upright of a landmark that was measured only by lines at one "
                    "height.")
            .number("loss_scale", &Options::loss_scale, Range::positive(),
                    "Number of standard deviations beyond which a measurement that disagrees loses influence (scale of "
                    "the Huber loss).");
    return declareIn(own);
  }();
  return table;
}

}  // namespace omnimapper::plugins
