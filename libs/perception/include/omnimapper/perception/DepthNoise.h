#pragma once

namespace omnimapper::perception {

/// What depth cameras that triangulate (Kinect, stereo) get wrong. Their error is constant in disparity, hence in
/// inverse depth 1/z, and that of the depth grows with its square: sigma_z = sigma z^2. So each figure is in 1/m, and
/// is the error in metres at 1 m. Default: a Kinect's, whose focal length times baseline is 43.5 px m, with 0.1 px of
/// noise and steps of 1/8 px. Source: Khoshelham, Elberink: Accuracy and resolution of Kinect depth data, Sensors
/// 12(2), 2012.
struct DepthNoise {
  double sigma = 0.0023;   ///< [1/m] of a single pixel
  double step = 0.0029;    ///< [1/m] between two values that the sensor can report
  double bend = 0.004;     ///< [1/m] by which a flat wall may seem bent: errors of calibration and lens
  double correlation = 9;  ///< [px^2]: neighbours that share an error; 1 = each pixel errs by itself
  /// [-] relative error of all depths alike, standard deviation; between a calibrated sensor's and one's as it comes:
  /// of the three sensors of the TUM RGB-D benchmark two were 3 % off, one not at all. Source: Sturm et al.: A
  /// benchmark for the evaluation of RGB-D SLAM systems, IROS 2012, and its page of file formats (depth scale).
  double scale = 0.01;

  /// Of one pixel, steps counted.
  double pixelVariance() const { return sigma * sigma + step * step / 12; }
  /// What n pixels' mean varies by, times n.
  double meanVariance() const { return sigma * sigma * correlation + step * step / 12; }
  /// Of what the image is bent by at one pixel: `bend` is its most, two standard deviations.
  double bendVariance() const { return 0.25 * bend * bend; }
};

}  // namespace omnimapper::perception
