#pragma once

#include <mrpt/img/CImage.h>
#include <omnimapper/sim_world/Random.h>

#include "Frame.h"

namespace omnimapper::sim {

/// How a camera turns light into a picture.
struct PhotographSettings {
  double gain = 1;          ///< factor on the light; with 1 a white wall is bright, but not overexposed
  double exposure = 0.01;   ///< exposure time, around the time of the picture [s]
  double noise = 0.012;     ///< standard deviation at full white, as part of full white, before the sRGB curve
  double vignetting = 0.2;  ///< part of the light that is lost in the corners
};

/// Takes a picture with 8 bits a channel, sRGB. `colours` are those of Shader::shade(); the camera's poses are those at
/// begin and end of the exposure. Only the camera's own motion blurs the picture: objects that move stay sharp.
mrpt::img::CImage photograph(const Frame& frame, std::vector<Eigen::Vector3f> colours,
                             const geometry::Se3& map_from_begin, const geometry::Se3& map_from_end,
                             const PhotographSettings& settings, Random random);

}  // namespace omnimapper::sim
