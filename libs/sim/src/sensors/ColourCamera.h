#pragma once

#include <omnimapper/sim/Sensor.h>

#include "../camera/Photograph.h"
#include "../camera/Shader.h"

namespace omnimapper::sim {

/// Options of ColourCamera.
struct ColourCameraOptions {
  int width = 640, height = 480;             ///< [pixel]
  double focal = 600;                        ///< at 640 pixels of width, in proportion else [pixel]
  double pan = 0, tilt = 0;                  ///< the middle of its sweeps: to the left, down [rad]
  double pan_sweep = 0, tilt_sweep = 0;      ///< to either side [rad]
  double pan_period = 10, tilt_period = 17;  ///< [s]
  double arm = 0;                            ///< from the crossing of the axes forward to the camera [m]
  double pan_sigma = 0, tilt_sigma = 0;      ///< standard deviation of what is told of each [rad]
  double pan_bias = 0, tilt_bias = 0;        ///< what is told less what is true [rad]
  double gain = 1;                           ///< times the light
  double exposure = 0.01;                    ///< [s]
  double noise = 0.012;                      ///< part of full white
  double vignetting = 0.2;                   ///< part of the light lost in the corners
  bool labels = false;                       ///< truth: a picture of surface numbers for each frame
  static const base::OptionTable<ColourCameraOptions>& table();
};

/// A colour camera on a pan-tilt: mrpt::obs::CObservationImage. The mount of the INI is that of the pan-tilt, x along
/// its middle; the observation's cameraPose is the optical frame, which looks along z, as the pan-tilt tells it.
///
/// Truth: k, stamp, time_s, pan_deg, tilt_deg, base_from_camera and map_from_camera (optical frame), faces in the
/// picture (facesInView()); files labels/.
class ColourCamera : public Sensor {
 public:
  ColourCamera(const ColourCameraOptions& options, const SensorOptions& mount, const SensorContext& context);
  Measurement measure(int k) const override;
  std::optional<CameraView> pictureView(int k) const override;
  std::size_t sizeOfMeasurement() const override;

 private:
  struct Angles {
    double pan, tilt;  // [rad]
  };
  Angles anglesAt(double time) const;
  geometry::Se3 baseFromCamera(const Angles& angles) const;
  geometry::Se3 mapFromCamera(double time) const;

  ColourCameraOptions options_of_camera_;
  Pinhole camera_;
  Shader shader_;
};

}  // namespace omnimapper::sim
