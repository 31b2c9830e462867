#pragma once

#include <omnimapper/base/OptionTable.h>

#include "../camera/DisparityModel.h"
#include "../camera/Photograph.h"

namespace omnimapper::sim {

enum class RgbdModel { kinect, xtion, stereo, ideal };

/// Options of RgbdCamera. Numbers that are -1 (colour_right: -1000) take the value of the model.
struct RgbdOptions {
  RgbdModel model = RgbdModel::kinect;
  int width = 640, height = 480;          ///< of both pictures [pixel]
  double focal = -1;                      ///< of the depth camera [pixel]
  double colour_focal = -1;               ///< [pixel]
  double colour_right = -1000;            ///< offset of the colour camera to the right of the depth camera [m]
  bool registered = true;                 ///< depth images are registered to the view of the colour camera
  bool colour = true;                     ///< the sensor also takes a colour picture
  double colour_delay = 0;                ///< delay of the picture after the depths; may be negative [s]
  double baseline = -1;                   ///< [m]
  double disparity_step = -1;             ///< [pixel]
  double disparity_sigma = -1;            ///< [pixel]
  int disparity_reach = -1;               ///< distance up to which errors are correlated [pixel]
  double match_share = -1;                ///< part of the matching window that must have one depth
  double signal_floor = -1;               ///< see DisparitySettings
  double min_range = -1, max_range = -1;  ///< [m]
  double unit = -1;                       ///< unit of the depths in the range image [m]
  double gain = 1;                        ///< factor on the light
  double exposure = 0.015;                ///< [s]
  double colour_noise = -1;               ///< standard deviation, as a part of full white
  double vignetting = 0.2;                ///< part of the light lost in the corners
  bool labels = false;                    ///< the truth contains an image of surface numbers for each frame
  bool true_depth = false;                ///< the truth contains an image of the exact depth for each frame
  static const base::OptionTable<RgbdOptions>& table();
};

/// The options with the values of the model filled in.
struct RgbdSettings {
  bool exact = false;         ///< depths are exact, without a sensor model
  bool from_texture = false;  ///< depths come from pictures, not from a projected pattern
  bool coincide = false;      ///< both cameras have the same view
  Pinhole depth_camera, colour_camera;
  double colour_right = 0;  ///< [m]
  double unit = 0.001;      ///< [m]
  DisparitySettings disparity;
  PhotographSettings photograph;
};
/// Throws base::Error(out_of_range) if options contradict each other; the message begins with `place`.
RgbdSettings settle(const RgbdOptions& options, const std::string& place);

}  // namespace omnimapper::sim
