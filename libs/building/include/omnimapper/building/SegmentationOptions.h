#pragma once

namespace omnimapper::building {

/// How much each property of a cut speaks for a door. The score of a cut is the sum; a door has a positive one, and
/// 1 / (1 + exp(-score)) is its confidence. doc/results/rooms.md says on which plans these were chosen.
struct DoorWeights {
  double bias = 2.83;
  double excess_width = -0.97;       ///< for each metre of width above usual_width
  double usual_width = 0.62;         ///< [m]
  double narrowing = -3.13;          ///< width divided by that of the smaller room
  double local_narrowing = -1.33;    ///< width divided by that of the free space close to the side that has less
  double wall_coverage = 2.79;       ///< share of wall on its line, between the rooms on both sides
  double less_aligned = 2.26;        ///< wall in line with the cut, beyond the end that has less; saturated
  double more_aligned = 0.36;        ///< beyond the other end
  double crossing = -0.4;            ///< share of wall that runs on through the ends
  double most_crossing = -1;         ///< at the end that has more of it
  double small_area = -3.25;         ///< if the smaller room had no area; falls with the room's area
  double usual_area = 5.26;          ///< [m^2] area at which small_area has fallen to 37 %
  double aligned_saturation = 0.35;  ///< share of wall from which on more does not count
};

/// Limits of the segmentation, in metres, so that they are the same for grids of any resolution.
struct SegmentationOptions {
  double least_area = 1;       ///< [m^2] smaller rooms are joined to others, or left out if there is none
  double clutter = 1;          ///< [m] largest diagonal of a free-standing thing that is taken out of its room
  double roughness = 0.12;     ///< [m] by which a wall may depart from a straight line
  double shortest_face = 0.5;  ///< [m] of a straight piece of the border of free space
  double shortest_wall = 1;    ///< [m] of all pieces of a wall together
  double wall_offset = 0.15;   ///< [m] distance of pieces of one wall from its line
  double longest_opening = 5;  ///< [m]
  double same_place = 0.3;     ///< [m] cuts whose ends are closer than this are one
  DoorWeights weights;
};

}  // namespace omnimapper::building
