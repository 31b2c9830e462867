#pragma once

#include <omnimapper/base/OptionTable.h>

#include "../camera/DisparityModel.h"
#include "../camera/Photograph.h"

namespace omnimapper::sim {

enum class RgbdModel { kinect, xtion, stereo, ideal };

/// Options of RgbdCamera. Numbers that are -1 are as the model has them.
struct RgbdOptions {
  RgbdModel model = RgbdModel::kinect;
  int width = 640, height = 480;          ///< of both pictures [pixel]
  double focal = -1;                      ///< of the depth camera [pixel]
  double colour_focal = -1;               ///< [pixel]
  double colour_right = -1000;            ///< of the colour camera, to the right of the depth camera [m]
  bool registered = true;                 ///< depth is handed out as the colour camera would see it
  bool colour = true;                     ///< there is a picture
  double colour_delay = 0;                ///< of the picture's stamp to that of the depths; may be negative [s]
  double baseline = -1;                   ///< [m]
  double disparity_step = -1;             ///< [pixel]
  double disparity_sigma = -1;            ///< [pixel]
  int disparity_reach = -1;               ///< over which errors resemble one another [pixel]
  double match_share = -1;                ///< of the window that has to be of one depth
  double signal_floor = -1;               ///< see DisparitySettings
  double min_range = -1, max_range = -1;  ///< [m]
  double unit = -1;                       ///< of the range image [m]
  double gain = 1;                        ///< times the light
  double exposure = 0.015;                ///< [s]
  double colour_noise = -1;               ///< part of full white
  double vignetting = 0.2;                ///< part of the light lost in the corners
  bool labels = false;                    ///< truth: a picture of surface numbers for each frame
  bool true_depth = false;                ///< truth: the exact depth for each frame
  static const base::OptionTable<RgbdOptions>& table();
};

/// What the options come to.
struct RgbdSettings {
  bool exact = false;         ///< depths are those of geometry
  bool from_texture = false;  ///< depths come from pictures, not from a projected pattern
  bool coincide = false;      ///< one camera makes both pictures, or depth is registered
  Pinhole depth_camera, colour_camera;
  double colour_right = 0;  ///< [m]
  double unit = 0.001;      ///< [m]
  DisparitySettings disparity;
  PhotographSettings photograph;
};
/// Throws base::Error(out_of_range) where options are against each other; `place` begins its message.
RgbdSettings settle(const RgbdOptions& options, const std::string& place);

}  // namespace omnimapper::sim
