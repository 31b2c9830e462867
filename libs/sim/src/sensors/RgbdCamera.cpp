#include "RgbdCamera.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "../camera/ViewTruth.h"
#include "FrameName.h"

namespace omnimapper::sim {

namespace {

constexpr std::uint64_t kDepthStream = 1, kColourStream = 2;

}  // namespace

/// The geometry of one measurement.
struct RgbdCamera::Pictures {
  double time, colour_time;         // [s]
  Frame depth;                      // of the depth camera
  std::optional<Frame> colour;      // of the picture; none: the depth camera's frame serves for both
  std::optional<Frame> handed_out;  // of the range image, if that is neither
  const Frame& picture() const { return colour ? *colour : depth; }
};

RgbdCamera::RgbdCamera(const RgbdOptions& options, const SensorOptions& mount, const SensorContext& context)
    : Sensor(mount, context),
      options_of_camera_(options),
      settings_(settle(options, context.place())),
      shader_(*context.world, *context.scenes),
      objects_(*context.world),
      sensor_from_colour_{Eigen::Quaterniond::Identity(), {0, -settings_.colour_right, 0}},
      hands_out_colour_view_(options.registered && !settings_.coincide) {}

geometry::Se3 RgbdCamera::mapFromColour(double time) const {
  return mapFromSensor(time) * sensor_from_colour_ * geometry::sensorFromOptical();
}

RgbdCamera::Pictures RgbdCamera::cast(double time) const {
  const Scenes& scenes = *context().scenes;
  const Scene scene = scenes.at(time);
  const double colour_time = time + options_of_camera_.colour_delay;
  Pictures pictures{
      time,
      colour_time,
      castFrame(scenes, scene, settings_.depth_camera, mapFromSensor(time) * geometry::sensorFromOptical()),
      {},
      {}};
  const bool at_once = options_of_camera_.colour_delay == 0;
  if (options_of_camera_.colour && !(settings_.coincide && at_once)) {
    pictures.colour = castFrame(scenes, at_once ? scene : scenes.at(colour_time), settings_.colour_camera,
                                mapFromColour(colour_time));
  }
  const bool wanted = settings_.exact || options_of_camera_.labels || options_of_camera_.true_depth ||
                      !context().world->objects.empty();
  if (hands_out_colour_view_ && wanted && !(options_of_camera_.colour && at_once))
    pictures.handed_out = castFrame(scenes, scene, settings_.colour_camera, mapFromColour(time));
  return pictures;
}

std::vector<float> RgbdCamera::sense(const Pictures& pictures, int k) const {
  const Frame& frame = pictures.depth;
  const DisparitySettings& disparity = settings_.disparity;
  const Scene scene = context().scenes->at(pictures.time);
  const std::vector<float> signal = settings_.from_texture ? textureSignal(shader_.shade(frame), frame.camera.width,
                                                                           frame.camera.height, disparity.window)
                                                           : patternSignal(*context().scenes, frame);
  return senseDepth(frame, scene, signal, disparity, randomOf(k, kDepthStream));
}

bool RgbdCamera::isInRange(float depth) const {
  return depth >= settings_.disparity.min_range && depth <= settings_.disparity.max_range;
}

void RgbdCamera::fillDepth(const std::vector<float>& depths, mrpt::obs::CObservation& observation) const {
  auto& scan = dynamic_cast<mrpt::obs::CObservation3DRangeScan&>(observation);
  const Pinhole& camera = hands_out_colour_view_ ? settings_.colour_camera : settings_.depth_camera;
  scan.hasRangeImage = true;
  scan.range_is_depth = true;
  scan.rangeUnits = static_cast<float>(settings_.unit);
  scan.maxRange = static_cast<float>(settings_.disparity.max_range);
  scan.cameraParams = camera.toMrpt();
  scan.cameraParamsIntensity = settings_.colour_camera.toMrpt();
  scan.sensorPose =
      geometry::toMrpt(hands_out_colour_view_ ? baseFromSensor() * sensor_from_colour_ : baseFromSensor());
  const double right = hands_out_colour_view_ ? 0 : settings_.colour_right;
  scan.relativePoseIntensityWRTDepth = mrpt::poses::CPose3D(0, -right, 0, -0.5 * M_PI, 0, -0.5 * M_PI);
  scan.rangeImage.resize(camera.height, camera.width);
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const float depth = depths[static_cast<std::size_t>(row) * camera.width + column];
      scan.rangeImage(row, column) = isInRange(depth) ? static_cast<std::uint16_t>(depth / settings_.unit + 0.5) : 0;
    }
  }
}

void RgbdCamera::fillColour(const Pictures& pictures, int k, mrpt::obs::CObservation& observation) const {
  auto& scan = dynamic_cast<mrpt::obs::CObservation3DRangeScan&>(observation);
  const double half = 0.5 * settings_.photograph.exposure;
  scan.hasIntensityImage = true;
  scan.intensityImage =
      photograph(pictures.picture(), shader_.shade(pictures.picture()), mapFromColour(pictures.colour_time - half),
                 mapFromColour(pictures.colour_time + half), settings_.photograph, randomOf(k, kColourStream));
}

// Points of pixels that are 2.5 cm apart at 4 m and in the range image. A depth measured through glass does not show
// the glass.
std::vector<VisiblePoint> RgbdCamera::seenPoints(const Frame& frame, const std::vector<float>& depths) const {
  constexpr double kGap = 0.025 / 4;  // between pixels, at 1 m [m]
  constexpr double kSame = 0.3;       // largest error of a Kinect at 4 m [m]
  const Pinhole& camera = frame.camera;
  const int step = std::max(1, static_cast<int>(kGap * camera.fx));
  std::vector<VisiblePoint> points;
  for (int row = step / 2; row < camera.height; row += step) {
    for (int column = step / 2; column < camera.width; column += step) {
      const PixelHit& hit = frame.at(column, row);
      const float depth = depths[static_cast<std::size_t>(row) * camera.width + column];
      if (hit.surface < 0 || !isInRange(depth) || std::abs(static_cast<double>(depth) - hit.depth) > kSame) continue;
      const Eigen::Vector3d in_optical = hit.depth * camera.through(column, row);
      if (!isSeenWell(in_optical.norm(), static_cast<double>(hit.cosine))) continue;
      if (isRegistered()) {
        const auto there = settings_.colour_camera.project(in_optical + depthToColour());
        if (!there || !settings_.colour_camera.contains(*there)) continue;
      }
      points.push_back({hit.surface, (frame.map_from_optical * in_optical).cast<float>()});
    }
  }
  return points;
}

std::optional<CameraView> RgbdCamera::pictureView(int k) const {
  if (!options_of_camera_.colour) return {};
  const double time = timeOf(k) + options_of_camera_.colour_delay;
  return CameraView{settings_.colour_camera, mapFromColour(time), time};
}

std::size_t RgbdCamera::sizeOfMeasurement() const {
  constexpr std::size_t kBytesOfPixel = 10;  // depth, colour, labels, and a seen point for one of nine pixels
  return kBytesOfPixel * static_cast<std::size_t>(options_of_camera_.width) *
         static_cast<std::size_t>(options_of_camera_.height);
}

Measurement RgbdCamera::measure(int k) const {
  const Pictures pictures = cast(timeOf(k));
  const Frame& exact = pictures.handed_out                         ? *pictures.handed_out
                       : hands_out_colour_view_ && pictures.colour ? *pictures.colour
                                                                   : pictures.depth;
  auto scan = mrpt::obs::CObservation3DRangeScan::Create();
  stamp(*scan, k);
  const std::vector<float> depths = settings_.exact ? exactDepth(exact) : sense(pictures, k);
  fillDepth(isRegistered() ? registerDepth(depths, settings_.depth_camera, settings_.colour_camera,
                                           {Eigen::Quaterniond::Identity(), depthToColour()})
                           : depths,
            *scan);
  nlohmann::ordered_json truth{{"time_s", pictures.time}};
  std::vector<SignView> signs;
  if (options_of_camera_.colour) {
    fillColour(pictures, k, *scan);
    const CameraView view = *pictureView(k);
    const Scene scene = context().scenes->at(view.time);
    signs = signsInView(*context().world, *context().scenes, scene, view);
    truth.update(facesInView(*context().world, *context().scenes, scene, view, signs));
    truth["picture_time_s"] = pictures.colour_time;
  }
  const geometry::Se3 sensor_from_handed_out = hands_out_colour_view_ ? sensor_from_colour_ : geometry::Se3{};
  truth["map_from_sensor"] = poseJson(mapFromSensor(pictures.time) * sensor_from_handed_out);
  Measurement measurement{scan, truth.dump(), {}};
  measurement.signs = std::move(signs);
  measurement.objects = objects_.find(exact, [&](int column, int row) { return scan->rangeImage(row, column) != 0; });
  measurement.seen = seenPoints(settings_.exact ? exact : pictures.depth, depths);
  const Pinhole& camera = exact.camera;
  if (options_of_camera_.labels) {
    measurement.truth_files.push_back(
        {frameName("labels", label(), k),
         draw::encodePng(draw::Grey16Image{camera.width, camera.height, labelsOf(exact)})});
  }
  if (options_of_camera_.true_depth) {
    measurement.truth_files.push_back(
        {frameName("depth", label(), k),
         draw::encodePng(draw::Grey16Image{camera.width, camera.height, depthsOf(exact, 0.0002)})});
  }
  return measurement;
}

}  // namespace omnimapper::sim
