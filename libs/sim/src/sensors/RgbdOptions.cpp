#include "RgbdOptions.h"

#include <omnimapper/base/Error.h>

#include <cmath>

#include "OptionChecks.h"

namespace omnimapper::sim {

namespace {

constexpr double kAsModel = -1, kNoOffset = -1000;

/// The values of a sensor model, at a width of 640 pixels.
struct Preset {
  double focal, colour_focal, colour_right, unit, colour_noise;
  DisparitySettings disparity;
};

// Focal lengths and baseline are from Khoshelham and Elberink, Accuracy and resolution of Kinect depth data for indoor
// mapping applications, Sensors 2012. The technical page of the kinect_calibration package of ROS says that the colour
// camera stands 2.5 cm to the right of the infrared one, and that 8 columns at the right edge stay empty. The rest is
// fitted to recordings: doc/results/simulator.md.
Preset preset(RgbdModel model) {
  Preset kinect{580, 525, 0.025, 0.001, 0.02, {}};
  kinect.disparity.blank_columns = 8;
  switch (model) {
    case RgbdModel::kinect:
      return kinect;
    case RgbdModel::xtion: {
      Preset xtion = kinect;
      xtion.focal = 570;
      xtion.colour_focal = 540;
      xtion.disparity.sigma *= 0.9;
      xtion.disparity.max_range = 8;
      xtion.colour_noise = 0.015;
      return xtion;
    }
    case RgbdModel::stereo: {
      Preset stereo{500, 500, 0, 0.001, 0.012, {}};
      stereo.disparity = {0.12, 1.0 / 16, 0.25, 4, 11, 0.5, 0.1, 2e-5, 1.0, 0, 0.4, 20};
      return stereo;
    }
    case RgbdModel::ideal:
      break;
  }
  Preset ideal{525, 525, 0, 0.0002, 0, {}};
  ideal.disparity.min_range = 0.05;
  ideal.disparity.max_range = 13;
  return ideal;
}

/// Values of a model, unless the INI gives others; those out of range are refused.
class ModelDefaults {
 public:
  explicit ModelDefaults(const std::string& place) : place_(place) {}

  double chosen(const char* key, double option, double of_model) const {
    if (option == kAsModel) return of_model;
    if (option < 0) refuseValue(place_, key, option, "must be 0 or more, or -1 for the value of the model");
    return option;
  }
  double positive(const char* key, double option, double of_model) const {
    const double value = chosen(key, option, of_model);
    if (!(value > 0)) refuseValue(place_, key, value, "must be above 0, or -1 for the value of the model");
    return value;
  }
  double offset(const char* key, double option, double of_model) const {
    if (option == kNoOffset) return of_model;
    if (std::abs(option) > 1)
      refuseValue(place_, key, option, "must be within [-1, 1], or -1000 for the value of the model");
    return option;
  }

 private:
  const std::string& place_;
};

}  // namespace

const base::OptionTable<RgbdOptions>& RgbdOptions::table() {
  using base::Range;
  const Range as_model_or_more{kAsModel, 1e6};
  static const auto table =
      base::OptionTable<RgbdOptions>()
          .choice("model", &RgbdOptions::model,
                  {{"kinect", RgbdModel::kinect},
                   {"xtion", RgbdModel::xtion},
                   {"stereo", RgbdModel::stereo},
                   {"ideal", RgbdModel::ideal}},
                  "Sensor model. Keys with the value -1 take the value of the model.")
          .integer("width_px", &RgbdOptions::width, {16, 4096},
                   "Number of columns of the depth image and of the colour image.")
          .integer("height_px", &RgbdOptions::height, {16, 4096},
                   "Number of rows of the depth image and of the colour image.")
          .number("focal_px", &RgbdOptions::focal, as_model_or_more,
                  "Focal length of the depth camera, or -1 for that of the model.")
          .number("colour_focal_px", &RgbdOptions::colour_focal, as_model_or_more,
                  "Focal length of the colour camera, or -1 for that of the model.")
          .number("colour_right_m", &RgbdOptions::colour_right, {kNoOffset, 1},
                  "Offset of the colour camera to the right of the depth camera, or -1000 for that of the model.")
          .flag("registered", &RgbdOptions::registered, "Depth images are registered to the view of the colour camera.")
          .flag("colour", &RgbdOptions::colour, "The sensor also provides a colour image.")
          .number("colour_delay_s", &RgbdOptions::colour_delay, {-1, 1},
                  "Delay of the colour image after the depth image, whose stamp is that of the observation.")
          .number("baseline_m", &RgbdOptions::baseline, as_model_or_more,
                  "Distance from the camera to its second eye, a projector or a second camera, or -1 for that of the "
                  "model.")
          .number("disparity_step_px", &RgbdOptions::disparity_step, as_model_or_more,
                  "Resolution of the disparities, which are rounded to multiples of it. 0 means that they are not "
                  "rounded, -1 takes the value of the model.")
          .number("disparity_sigma_px", &RgbdOptions::disparity_sigma, as_model_or_more,
                  "Standard deviation of the disparity on bright surfaces, or -1 for that of the model.")
          .integer("disparity_reach_px", &RgbdOptions::disparity_reach, {-1, 100},
                   "Distance in the image up to which errors of the disparity are correlated, or -1 for that of the "
                   "model.")
          .number("match_share", &RgbdOptions::match_share, {kAsModel, 1},
                  "Fraction of the matching window that must have one depth, or else the depth image has a hole there. "
                  "-1 takes the value of the model.")
          .number("signal_floor", &RgbdOptions::signal_floor, as_model_or_more,
                  "Brightness of the projected pattern (1 on a white wall at 1 m), or with stereo mean square slope of "
                  "the image, below which there is no depth. -1 takes the value of the model.")
          .number("min_range_m", &RgbdOptions::min_range, as_model_or_more,
                  "Smallest depth that is reported, or -1 for that of the model.")
          .number("max_range_m", &RgbdOptions::max_range, as_model_or_more,
                  "Largest depth that is reported, or -1 for that of the model.")
          .number("range_unit_m", &RgbdOptions::unit, {kAsModel, 0.1},
                  "Unit of the depths in the range image, or -1 for that of the model.")
          .number("gain", &RgbdOptions::gain, Range::positive(),
                  "Factor on the light in the colour image. With 1 a white wall is bright.")
          .number("exposure_s", &RgbdOptions::exposure, {0, 1}, "Exposure time of the colour image.")
          .number("colour_noise", &RgbdOptions::colour_noise, {kAsModel, 1},
                  "Standard deviation of the noise at full white as a fraction of full white, or -1 for that of the "
                  "model.")
          .number("vignetting", &RgbdOptions::vignetting, {0, 1},
                  "Fraction of the light that is lost in the corners of the colour image.")
          .flag("labels", &RgbdOptions::labels, "The ground truth contains an image of surface numbers for each frame.")
          .flag("true_depth", &RgbdOptions::true_depth,
                "The ground truth contains an image of the exact depth for each frame, with 5000 units per metre.");
  return table;
}

RgbdSettings settle(const RgbdOptions& options, const std::string& place) {
  const Preset model = preset(options.model);
  const ModelDefaults defaults(place);
  const double scale = options.width / 640.0;
  RgbdSettings settings;
  settings.exact = options.model == RgbdModel::ideal;
  settings.from_texture = options.model == RgbdModel::stereo;
  if (settings.from_texture && (options.colour_focal != kAsModel || options.colour_right != kNoOffset)) {
    throw base::Error(base::ExitCode::out_of_range, place +
                                                        "colour_focal_px, colour_right_m: with model = stereo the "
                                                        "left camera also takes the picture; leave these keys out");
  }
  const double focal = defaults.positive("focal_px", options.focal, scale * model.focal);
  const double colour_focal =
      settings.from_texture ? focal
                            : defaults.positive("colour_focal_px", options.colour_focal, scale * model.colour_focal);
  settings.depth_camera = Pinhole::centred(options.width, options.height, focal);
  settings.colour_camera = Pinhole::centred(options.width, options.height, colour_focal);
  settings.colour_right = defaults.offset("colour_right_m", options.colour_right, model.colour_right);
  settings.unit = defaults.positive("range_unit_m", options.unit, model.unit);
  DisparitySettings& disparity = settings.disparity = model.disparity;
  disparity.baseline = defaults.positive("baseline_m", options.baseline, disparity.baseline);
  disparity.step = defaults.chosen("disparity_step_px", options.disparity_step, disparity.step);
  disparity.sigma = defaults.chosen("disparity_sigma_px", options.disparity_sigma, disparity.sigma);
  if (options.disparity_reach >= 0) disparity.reach = options.disparity_reach;
  disparity.need = defaults.chosen("match_share", options.match_share, disparity.need);
  disparity.signal_floor = defaults.chosen("signal_floor", options.signal_floor, disparity.signal_floor);
  disparity.min_range = defaults.chosen("min_range_m", options.min_range, disparity.min_range);
  disparity.max_range = defaults.chosen("max_range_m", options.max_range, disparity.max_range);
  requireBelow(place, "min_range_m", disparity.min_range, "max_range_m", disparity.max_range);
  if (disparity.max_range / settings.unit > 65535) {
    refuseValue(place, "max_range_m", disparity.max_range,
                "does not fit into 16 bits of range_unit_m = " + base::option_text::format(settings.unit) +
                    "; make the unit larger");
  }
  settings.photograph = {options.gain, options.exposure,
                         defaults.chosen("colour_noise", options.colour_noise, model.colour_noise), options.vignetting};
  settings.coincide = settings.colour_right == 0 && focal == colour_focal;
  return settings;
}

}  // namespace omnimapper::sim
