#include "ColourCamera.h"

#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>

#include <cmath>

#include "../camera/ViewTruth.h"
#include "FrameName.h"

namespace omnimapper::sim {

namespace {

constexpr std::uint64_t kPoseStream = 1, kPictureStream = 2;

}  // namespace

const base::OptionTable<ColourCameraOptions>& ColourCameraOptions::table() {
  using base::Range;
  using O = ColourCameraOptions;
  static const auto table =
      base::OptionTable<O>()
          .integer("width_px", &O::width, {16, 4096}, "Number of columns of the image.")
          .integer("height_px", &O::height, {16, 4096}, "Number of rows of the image.")
          .number("focal_px", &O::focal, Range::positive(),
                  "Focal length of an image with 640 columns. It scales with the number of columns.")
          .number("pan_deg", &O::pan, {-360, 360}, "Centre of the pan sweep, positive to the left.")
          .number("tilt_deg", &O::tilt, {-180, 180}, "Centre of the tilt sweep, positive downwards.")
          .number("pan_sweep_deg", &O::pan_sweep, {0, 360}, "Amplitude of the pan sweep to either side.")
          .number("tilt_sweep_deg", &O::tilt_sweep, {0, 90}, "Amplitude of the tilt sweep up and down.")
          .number("pan_period_s", &O::pan_period, Range::positive(), "Period of the pan sweep to both sides and back.")
          .number("tilt_period_s", &O::tilt_period, Range::positive(), "Period of the tilt sweep up, down and back.")
          .number("arm_m", &O::arm, {-10, 10},
                  "Distance of the camera in front of the point where the pan and tilt axes cross.")
          .number("pan_sigma_deg", &O::pan_sigma, {0, 45},
                  "Standard deviation of the reported pan angle, independent in each image.")
          .number("tilt_sigma_deg", &O::tilt_sigma, {0, 45},
                  "Standard deviation of the reported tilt angle, independent in each image.")
          .number("pan_bias_deg", &O::pan_bias, {-45, 45},
                  "Constant offset of the reported pan angle from the true one.")
          .number("tilt_bias_deg", &O::tilt_bias, {-45, 45},
                  "Constant offset of the reported tilt angle from the true one.")
          .number("gain", &O::gain, Range::positive(),
                  "Factor on the light in the image. With 1 a white wall is bright.")
          .number("exposure_s", &O::exposure, {0, 1}, "Exposure time of the image.")
          .number("noise", &O::noise, {0, 1},
                  "Standard deviation of the noise at full white as a fraction of full white.")
          .number("vignetting", &O::vignetting, {0, 1},
                  "Fraction of the light that is lost in the corners of the image.")
          .flag("labels", &O::labels, "The ground truth contains an image of surface numbers for each frame.");
  return table;
}

ColourCamera::ColourCamera(const ColourCameraOptions& options, const SensorOptions& mount, const SensorContext& context)
    : Sensor(mount, context),
      options_of_camera_(options),
      camera_(Pinhole::centred(options.width, options.height, options.focal * options.width / 640.0)),
      shader_(*context.world, *context.scenes),
      objects_(*context.world) {}

ColourCamera::Angles ColourCamera::anglesAt(double time) const {
  const ColourCameraOptions& o = options_of_camera_;
  return {o.pan + o.pan_sweep * std::sin(2 * M_PI * time / o.pan_period),
          o.tilt + o.tilt_sweep * std::sin(2 * M_PI * time / o.tilt_period)};
}

geometry::Se3 ColourCamera::baseFromCamera(const Angles& angles) const {
  const geometry::Se3 mount_from_turned{Eigen::AngleAxisd(angles.pan, Eigen::Vector3d::UnitZ()) *
                                            Eigen::AngleAxisd(angles.tilt, Eigen::Vector3d::UnitY()),
                                        Eigen::Vector3d::Zero()};
  const geometry::Se3 turned_from_camera{Eigen::Quaterniond::Identity(), {options_of_camera_.arm, 0, 0}};
  return baseFromSensor() * mount_from_turned * turned_from_camera * geometry::sensorFromOptical();
}

geometry::Se3 ColourCamera::mapFromCamera(double time) const {
  return *context().map_from_base->at(time) * baseFromCamera(anglesAt(time));
}

std::optional<CameraView> ColourCamera::pictureView(int k) const {
  return CameraView{camera_, mapFromCamera(timeOf(k)), timeOf(k)};
}

std::size_t ColourCamera::sizeOfMeasurement() const {
  constexpr std::size_t kBytesOfPixel = 6;  // colour, labels
  return kBytesOfPixel * static_cast<std::size_t>(camera_.width) * static_cast<std::size_t>(camera_.height);
}

Measurement ColourCamera::measure(int k) const {
  const ColourCameraOptions& o = options_of_camera_;
  const double time = timeOf(k), half = 0.5 * o.exposure;
  const Angles angles = anglesAt(time);
  const Scene scene = context().scenes->at(time);
  const CameraView view = *pictureView(k);
  const Frame frame = castFrame(*context().scenes, scene, camera_, view.map_from_optical);
  Random random = randomOf(k, kPoseStream);
  const double reported_pan = angles.pan + o.pan_bias + random.gaussian(o.pan_sigma);
  const double reported_tilt = angles.tilt + o.tilt_bias + random.gaussian(o.tilt_sigma);

  auto picture = mrpt::obs::CObservationImage::Create();
  stamp(*picture, k);
  picture->cameraParams = camera_.toMrpt();
  picture->cameraPose = geometry::toMrpt(baseFromCamera({reported_pan, reported_tilt}));
  picture->image = photograph(frame, shader_.shade(frame), mapFromCamera(time - half), mapFromCamera(time + half),
                              {o.gain, o.exposure, o.noise, o.vignetting}, randomOf(k, kPictureStream));

  nlohmann::ordered_json truth{{"time_s", time}};
  truth["pan_deg"] = angles.pan * 180 / M_PI;
  truth["tilt_deg"] = angles.tilt * 180 / M_PI;
  truth["base_from_camera"] = poseJson(baseFromCamera(angles));
  truth["map_from_camera"] = poseJson(frame.map_from_optical);
  const std::vector<SignView> signs = signsInView(*context().world, *context().scenes, scene, view);
  truth.update(facesInView(*context().world, *context().scenes, scene, view, signs));
  Measurement measurement{picture, truth.dump(), {}};
  measurement.signs = signs;
  measurement.objects = objects_.find(frame, [](int, int) { return false; });
  if (o.labels) {
    measurement.truth_files.push_back(
        {frameName("labels", label(), k),
         draw::encodePng(draw::Grey16Image{camera_.width, camera_.height, labelsOf(frame)})});
  }
  return measurement;
}

}  // namespace omnimapper::sim
