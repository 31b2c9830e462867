#pragma once

#include <omnimapper/sim/Sensor.h>

#include "../camera/ObjectsInFrame.h"
#include "../camera/Photograph.h"
#include "../camera/Shader.h"

namespace omnimapper::sim {

/// Options of ColourCamera.
struct ColourCameraOptions {
  int width = 640, height = 480;             ///< [pixel]
  double focal = 600;                        ///< at a width of 640 pixels, in proportion at other widths [pixel]
  double pan = 0, tilt = 0;                  ///< centre of the sweeps, positive to the left and down [rad]
  double pan_sweep = 0, tilt_sweep = 0;      ///< amplitude to either side [rad]
  double pan_period = 10, tilt_period = 17;  ///< [s]
  double arm = 0;                            ///< distance of the camera in front of the point where the axes cross [m]
  double pan_sigma = 0, tilt_sigma = 0;      ///< standard deviation of the reported angles [rad]
  double pan_bias = 0, tilt_bias = 0;        ///< reported minus true angles [rad]
  double gain = 1;                           ///< factor on the light
  double exposure = 0.01;                    ///< [s]
  double noise = 0.012;                      ///< standard deviation, as a part of full white
  double vignetting = 0.2;                   ///< part of the light lost in the corners
  bool labels = false;                       ///< the truth contains an image of surface numbers for each frame
  static const base::OptionTable<ColourCameraOptions>& table();
};

/// A colour camera on a pan-tilt unit: mrpt::obs::CObservationImage. The pose in the INI is that of the unit, with x
/// along the camera's axis at zero angles. The observation's cameraPose is that of the optical frame, which looks along
/// z, computed from the reported angles.
///
/// Truth: k, stamp, time_s, pan_deg, tilt_deg, base_from_camera and map_from_camera (optical frame), and faces in the
/// picture (facesInView()); images in labels/.
class ColourCamera : public Sensor {
 public:
  ColourCamera(const ColourCameraOptions& options, const SensorOptions& mount, const SensorContext& context);
  Measurement measure(int k) const override;
  std::optional<CameraView> pictureView(int k) const override;
  bool isCamera() const override { return true; }
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
  ObjectsInFrame objects_;
};

}  // namespace omnimapper::sim
