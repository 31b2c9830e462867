#include <omnimapper/base/Error.h>
#include <omnimapper/camera/CameraCalibration.h>
#include <omnimapper/camera/cameraOptions.h>

#include <algorithm>
#include <array>

namespace omnimapper::camera {

namespace {

using Options = CameraCalibrationOptions;
using Number = Options::Number;

// Parameters of one camera: fx, fy, cx, cy, then its lens in MRPT's order.
using CameraNumbers = std::array<Number, 9>;

CameraNumbers depthNumbers(const Options& o) {
  return {o.depth_fx, o.depth_fy, o.depth_cx, o.depth_cy, o.depth_k1, o.depth_k2, o.depth_p1, o.depth_p2, o.depth_k3};
}

CameraNumbers pictureNumbers(const Options& o) {
  return {o.picture_fx, o.picture_fy, o.picture_cx, o.picture_cy, o.picture_k1,
          o.picture_k2, o.picture_p1, o.picture_p2, o.picture_k3};
}

void set(mrpt::img::TCamera& camera, const CameraNumbers& numbers) {
  const bool sets_lens = std::any_of(numbers.begin() + 4, numbers.end(), [](const Number& n) { return n.has_value(); });
  // The coefficients of a fisheye belong to another model, so none of them are kept.
  if (sets_lens && camera.distortion != mrpt::img::DistortionModel::plumb_bob) camera.dist.fill(0);
  if (sets_lens) camera.distortion = mrpt::img::DistortionModel::plumb_bob;
  if (numbers[0]) camera.fx(*numbers[0]);
  if (numbers[1]) camera.fy(*numbers[1]);
  if (numbers[2]) camera.cx(*numbers[2]);
  if (numbers[3]) camera.cy(*numbers[3]);
  for (std::size_t i = 4; i < numbers.size(); ++i)
    if (numbers[i]) camera.dist[i - 4] = *numbers[i];
}

std::vector<double> numbersOf(const std::vector<std::string>& texts) {
  constexpr double kMost = 1;  // [1/m], which would be an error of 1 m at 1 m
  std::vector<double> numbers;
  for (const auto& text : texts) {
    double number = 0;
    const auto bad = base::option_text::parse(text, {-kMost, kMost}, number);
    if (bad)
      throw base::Error(
          bad->kind == base::BadValue::Kind::type ? base::ExitCode::wrong_type : base::ExitCode::out_of_range,
          "[calibration] depth_distortion_per_m: '" + text + "' is not " + bad->expected);
    numbers.push_back(number);
  }
  return numbers;
}

DepthDistortion distortionOf(const std::vector<std::string>& texts) {
  auto numbers = numbersOf(texts);
  try {
    return DepthDistortion(std::move(numbers));
  } catch (const base::Error& error) {
    throw base::Error(error.code(), std::string("[calibration] depth_distortion_per_m: ") + error.what());
  }
}

}  // namespace

const base::OptionTable<Options>& Options::table() {
  static const auto table = [] {
    base::OptionTable<Options> all;
    all.text("label", &Options::label, "Sensor label of the depth camera that is calibrated; empty for all of them.");
    addIntrinsics(all);
    all.number("depth_scale", &Options::depth_scale, {1e-4, 1e4}, "True depth divided by the depth in the log.")
        .flag("depth_is_range", &Options::depth_is_range,
              "Whether the pixels of the depth image hold distances from the camera, although the log says that they "
              "hold depths, which are measured along the optical axis.")
        .flag("mirrored", &Options::mirrored,
              "Whether the images are mirror images, with left and right exchanged. They are mirrored back.")
        .list("depth_distortion_per_m", &Options::depth_distortion,
              "Correction of depths that depends on the pixel: coefficients of products of Legendre polynomials, as "
              "omnimapper-calibrate depth writes them. The sum of these products, each times its coefficient, is "
              "added to the inverse depth of a pixel before depth_scale is applied.");
    addPicturePose(all);
    return all;
  }();
  return table;
}

CameraCalibration::CameraCalibration(const Options& options)
    : options_(options), depth_distortion_(distortionOf(options.depth_distortion)), is_set_(true) {
  const std::array<Number, 6> pose{options.picture_x,   options.picture_y,     options.picture_z,
                                   options.picture_yaw, options.picture_pitch, options.picture_roll};
  const auto given = std::count_if(pose.begin(), pose.end(), [](const Number& n) { return n.has_value(); });
  if (given == 0 || given == 6) return;
  throw base::Error(
      base::ExitCode::out_of_range,
      "[calibration] gives only a part of the pose of the picture's camera: it takes all of picture_x_m, "
      "picture_y_m, picture_z_m, picture_yaw_deg, picture_pitch_deg and picture_roll_deg, or none of them");
}

CameraCalibration CameraCalibration::read(const base::Config& config) {
  if (!config.has("calibration")) return {};
  const auto options = config.section("calibration").read<Options>();
  try {
    return CameraCalibration(options);
  } catch (const base::Error& error) {
    throw base::Error(error.code(), config.placeOf("calibration") + ": " + error.what());
  }
}

namespace {

// The calibration stays that of the camera: the images are what it saw once they are mirrored back.
void mirror(mrpt::obs::CObservation3DRangeScan& scan) {
  if (scan.hasRangeImage) scan.rangeImage.asEigen() = scan.rangeImage.asEigen().rowwise().reverse().eval();
  if (!scan.hasIntensityImage) return;
  scan.intensityImage = scan.intensityImage.makeDeepCopy();  // copies of observations share the pixels of their images
  scan.intensityImage.flipHorizontal();
}

}  // namespace

void CameraCalibration::applyTo(mrpt::obs::CObservation3DRangeScan& scan) const {
  if (options_.mirrored) mirror(scan);
  if (options_.depth_is_range) scan.range_is_depth = false;
  set(scan.cameraParams, depthNumbers(options_));
  depth_distortion_.applyTo(scan);  // before depth_scale changes the units
  set(scan.cameraParamsIntensity, pictureNumbers(options_));
  if (options_.depth_scale)
    scan.rangeUnits = static_cast<float>(static_cast<double>(scan.rangeUnits) * *options_.depth_scale);
  if (options_.picture_x) {
    scan.relativePoseIntensityWRTDepth =
        mrpt::poses::CPose3D(*options_.picture_x, *options_.picture_y, *options_.picture_z, *options_.picture_yaw,
                             *options_.picture_pitch, *options_.picture_roll);
  }
}

}  // namespace omnimapper::camera
