#pragma once

#include <omnimapper/sim_world/Random.h>

#include <vector>

#include "Frame.h"

namespace omnimapper::sim {

/// How a sensor with two eyes (a camera and a projector of a pattern, or two cameras) gets depth from disparity.
struct DisparitySettings {
  double baseline = 0.075;                 ///< of the second eye, to the right of the camera [m]
  double step = 0.125;                     ///< disparities are multiples of this; 0: not rounded [pixel]
  double sigma = 0.06;                     ///< standard deviation of the disparity on a bright surface [pixel]
  int reach = 5;                           ///< pixels over which its errors resemble one another
  int window = 9;                          ///< side of the square that is matched [pixel]
  double need = 0.33;                      ///< part of the window that must be of one depth for a match
  double need_spread = 0.08;               ///< standard deviation of that part
  double signal_floor = 0.013;             ///< below it nothing is matched: see patternSignal() and textureSignal()
  double signal_spread = 0.8;              ///< standard deviation of the logarithm of the signal
  int blank_columns = 0;                   ///< at the right edge, without depth
  double min_range = 0.5, max_range = 10;  ///< depths outside are not reported [m]
};

/// The brightness of a pattern that is projected in infrared: 1 on a white wall at 1 m that faces the camera. It falls
/// with the square of the distance, with the cosine, and with what the surface scatters back; of glass little comes
/// back, and of what is behind it nothing.
std::vector<float> patternSignal(const Scenes& scenes, const Frame& frame);

/// The texture that a matcher of pictures finds: mean square of the horizontal derivative of the picture's brightness
/// over the window, with full white 1. `colours` as Shader::shade().
std::vector<float> textureSignal(const std::vector<Eigen::Vector3f>& colours, int width, int height, int window);

/// Depths of the pixels as the sensor measures them, 0 where it does not [m].
std::vector<float> senseDepth(const Frame& frame, const Scene& scene, const std::vector<float>& signal,
                              const DisparitySettings& settings, Random random);

/// Depths seen by one camera as another one would have them at its pixels, the nearest where several fall on one; 0
/// where none does. What drivers call registered depth.
std::vector<float> registerDepth(const std::vector<float>& depths, const Pinhole& from, const Pinhole& to,
                                 const geometry::Se3& to_from_from);

}  // namespace omnimapper::sim
