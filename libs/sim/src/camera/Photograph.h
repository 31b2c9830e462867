#pragma once

#include <mrpt/img/CImage.h>
#include <omnimapper/sim_world/Random.h>

#include "Frame.h"

namespace omnimapper::sim {

/// How a camera makes a picture of light.
struct PhotographSettings {
  double gain = 1;          ///< times the light; 1: a white wall is bright, not blown out
  double exposure = 0.01;   ///< how long it takes light, around its time [s]
  double noise = 0.012;     ///< standard deviation at full white, as part of full white, before the sRGB curve
  double vignetting = 0.2;  ///< part of the light that is lost in the corners
};

/// The picture, 8 bits a channel, sRGB. `colours` as Shader::shade(); the camera's poses are those when the exposure
/// begins and ends. The picture is smeared by the camera's motion alone: things that move stay sharp.
mrpt::img::CImage photograph(const Frame& frame, std::vector<Eigen::Vector3f> colours,
                             const geometry::Se3& map_from_begin, const geometry::Se3& map_from_end,
                             const PhotographSettings& settings, Random random);

}  // namespace omnimapper::sim
