#include "SignLandmarksOptions.h"

namespace omnimapper::plugins {

const base::OptionTable<SignLandmarksOptions>& SignLandmarksOptions::table() {
  using Options = SignLandmarksOptions;
  using base::Range;
  static const auto table = [] {
    auto own =
        base::OptionTable<Options>()
            .text("label", &Options::label,
                  "Sensor label of the sign observations, such as \"camera.signs\"; empty for those of every camera.")
            .number("min_confidence", &Options::min_confidence, {0, 1},
                    "Lines of text with a lower confidence than this are not used.")
            .number("pixel_sigma_deg", &Options::pixel_sigma, Range{0.001, 45},
                    "Standard deviation of the direction to the middle of a sign in the image, apart from the errors "
                    "of the camera's pan and tilt angles.")
            .number("pan_sigma_deg", &Options::pan_sigma, Range{0, 45},
                    "Standard deviation of the error of the pan angle that a camera reports. The error differs from "
                    "image to image.")
            .number("tilt_sigma_deg", &Options::tilt_sigma, Range{0, 45},
                    "Standard deviation of the error of the tilt angle that a camera reports. The error differs from "
                    "image to image.")
            .number("pan_tilt_offset_sigma_deg", &Options::pan_tilt_offset_sigma, Range{0, 45},
                    "Standard deviation of the constant offsets of the camera's pan and tilt angles, which are "
                    "estimated; 0 assumes that there are no offsets.")
            .number("max_sigma_m", &Options::max_sigma, Range{0.001, 100},
                    "A new sign is added to the map once the standard deviation of its position is at most this. Until "
                    "then only the directions to the sign are kept.")
            .number("recent_m", &Options::recent_travel, Range::positive(),
                    "If the robot has travelled farther than this since it last measured a sign, new measurements of "
                    "the sign make a second landmark, and a hypothesis that both are one sign. If the hypothesis is "
                    "accepted, it closes a loop.")
            .number("same_sigma_m", &Options::same_sigma, Range{0.001, 10},
                    "Standard deviation of the difference between the positions of one sign as measured on two visits.")
            .number("loss_scale", &Options::loss_scale, Range{0.1, 100},
                    "Number of standard deviations beyond which a measurement that disagrees loses influence (scale of "
                    "the Cauchy loss).");
    return declareIn(own);
  }();
  return table;
}

}  // namespace omnimapper::plugins
