#pragma once

namespace omnimapper::camera {

/// Errors of depth cameras that triangulate (Kinect, stereo). Their size is the same at all depths if they are stated
/// as errors of the disparity, hence also as errors of the inverse depth 1/z. Errors of the depth itself grow with its
/// square: sigma_z = sigma z^2. An error of the inverse depth [1/m] is therefore the error of the depth [m] at a depth
/// of 1 m. Default: a Kinect, whose focal length times baseline is 43.5 px m, with 0.1 px of noise and steps of 1/8 px.
/// Source: Khoshelham, Elberink: Accuracy and resolution of Kinect depth data, Sensors 12(2), 2012.
struct DepthNoise {
  double sigma = 0.0023;      ///< [1/m] standard deviation of a single pixel
  double step = 0.0029;       ///< [1/m] difference between successive values that the sensor can report
  double distortion = 0.004;  ///< [1/m] largest systematic distortion of a wall, due to calibration and lens
  double correlation = 9;     ///< [px^2] number of pixels that share an error; 1: pixels are independent
  /// [-] standard deviation of a relative error that all depths share. The default lies between the errors of a
  /// calibrated sensor and of a sensor as it is sold: of the three sensors of the TUM RGB-D benchmark two were 3 % off,
  /// one not at all. Source: Sturm et al.: A benchmark for the evaluation of RGB-D SLAM systems, IROS 2012, and its
  /// page of file formats (depth scale).
  double scale = 0.01;

  /// Variance of one pixel, including the rounding to steps.
  double pixelVariance() const { return sigma * sigma + step * step / 12; }
  /// Variance of the mean of n pixels, multiplied by n.
  double meanVariance() const { return sigma * sigma * correlation + step * step / 12; }
  /// Variance of the systematic distortion at one pixel; `distortion` is two standard deviations.
  double distortionVariance() const { return 0.25 * distortion * distortion; }
};

}  // namespace omnimapper::camera
