#pragma once

#include <omnimapper/sim_world/Random.h>

#include <vector>

#include "Frame.h"

namespace omnimapper::sim {

/// How a sensor with two eyes (a camera and a projector of a pattern, or two cameras) measures depth by disparity.
struct DisparitySettings {
  double baseline = 0.075;      ///< of the second eye, to the right of the camera [m]
  double step = 0.125;          ///< disparities are multiples of this; 0: not rounded [pixel]
  double sigma = 0.06;          ///< standard deviation of the disparity on a bright surface [pixel]
  int reach = 5;                ///< distance up to which its errors are correlated [pixel]
  int window = 9;               ///< side of the square that is matched [pixel]
  double need = 0.33;           ///< part of the window that must have one depth for a match
  double need_spread = 0.08;    ///< standard deviation of that part
  double signal_floor = 0.013;  ///< signal below which nothing is matched, see patternSignal() and textureSignal()
  double signal_spread = 0.8;   ///< standard deviation of the logarithm of the signal
  int blank_columns = 0;        ///< columns at the right edge without depth
  double min_range = 0.5, max_range = 10;  ///< depths outside are not reported [m]
};

/// The brightness of a pattern that is projected in infrared: 1 on a white wall at 1 m that faces the camera. It is
/// proportional to the cosine of incidence and to the infrared reflection of the surface, and falls with the square of
/// the distance. Glass sends little of it back, and surfaces behind glass none.
std::vector<float> patternSignal(const Scenes& scenes, const Frame& frame);

/// The texture that a stereo matcher finds: mean square of the horizontal derivative of the picture's brightness over
/// the window, where full white is 1. `colours` are those of Shader::shade().
std::vector<float> textureSignal(const std::vector<Eigen::Vector3f>& colours, int width, int height, int window);

/// Depths that the sensor measures at the pixels, 0 where it measures none [m].
std::vector<float> senseDepth(const Frame& frame, const Scene& scene, const std::vector<float>& signal,
                              const DisparitySettings& settings, Random random);

/// Depths of one camera at the pixels of another, which drivers call registered depth: the nearest where several fall
/// on one pixel, 0 where none does.
std::vector<float> registerDepth(const std::vector<float>& depths, const Pinhole& from, const Pinhole& to,
                                 const geometry::Se3& to_from_from);

}  // namespace omnimapper::sim
