#include <omnimapper/base/Error.h>
#include <omnimapper/perception/RoadComparator.h>
#include <omnimapper/perception/RoadSegmenter.h>
#include <omnimapper/perception/SameLabel.h>

#include <algorithm>
#include <cmath>

#include "DepthSensor.h"
#include "planes/Description.h"
#include "road/GroundGrowth.h"

namespace omnimapper::perception {

const base::OptionTable<RoadOptions>& RoadOptions::table() {
  using base::Range;
  static const auto table =
      depthSensorTable<RoadOptions>()
          .number("scale_sigma", &RoadOptions::scale_sigma, {0, 1}, kScaleHelp)
          .integer("window_radius_px", &RoadOptions::window_radius, {1, 7},
                   "Radius r of the square window around a pixel from which the pixel's normal is estimated. The "
                   "window has 2 r + 1 pixels a side.")
          .number(
              "max_tilt_deg", &RoadOptions::max_tilt, {0, 89},
              "Largest angle between the ground's normal and the normal of the ground that the camera's pose predicts.")
          .number("max_turn_deg", &RoadOptions::max_turn, {0, 89},
                  "Largest angle between the normals of neighbouring ground pixels.")
          .number("max_off_m", &RoadOptions::max_off, Range::notNegative(),
                  "Near the sensor, the largest height of the ground above or below the height that the camera's pose "
                  "predicts. This limit grows with the depth, by the slope max_slope_deg.")
          .number("max_slope_deg", &RoadOptions::max_slope, {0, 45},
                  "Slope by which the limit max_off_m grows with the depth.")
          .number("grow_sigmas", &RoadOptions::grow_sigmas, {1, 100},
                  "A pixel without a known normal belongs to the ground if it is within this many standard deviations "
                  "of the ground around it.")
          .number("step_sigmas", &RoadOptions::step_sigmas, {1, 100},
                  "A step in the height of the ground, such as a kerb, does not belong to the ground if it is higher "
                  "than this many standard deviations.")
          .integer("min_pixels", &RoadOptions::min_pixels, {1, 1e9}, "Ground regions with fewer pixels are left out.")
          .integer("min_hole_pixels", &RoadOptions::min_hole_pixels, {1, 1e9},
                   "Holes in the ground that have fewer pixels than this are not outlined.");
  return table;
}

namespace {

constexpr int kLeastSeed = 200;      // fewest pixels of a component from which the second pass grows the ground
constexpr float kStanding = 0.423F;  // cosine of 65 degrees: surfaces steeper than this to the ground stand on it
constexpr int kFootRows = 6;         // [px] rows of a foot, see feetOf()

NormalImage normalsOf(const camera::DepthImage& image, const RoadOptions& options) {
  return NormalEstimator(normalsBy(options, options.window_radius)).estimate(image);
}

// Pixels of connected components that are large enough.
std::vector<std::uint8_t> seedsOf(const Components& components) {
  std::vector<std::uint8_t> seeds;
  for (const auto label : components.labels(kLeastSeed)) seeds.push_back(label != 0);
  return seeds;
}

// 1 for pixels of objects that stand on the ground and for the pixels just below them, which the windows of stereo
// matching mix with the object.
std::vector<std::uint8_t> feetOf(const NormalImage& normals, const Eigen::Vector3f& up) {
  std::vector<std::uint8_t> feet(normals.size(), 0);
  // For each column, the number of further rows that belong to the foot.
  std::vector<int> left(static_cast<std::size_t>(normals.width), 0);
  std::size_t i = 0;
  for (int y = 0; y < normals.height; ++y) {
    for (int& of_column : left) {
      const float cosine = normals.x()[i] * up.x() + normals.y()[i] * up.y() + normals.z()[i] * up.z();
      of_column = cosine < kStanding ? kFootRows : of_column - 1;
      feet[i++] = of_column > 0;
    }
  }
  return feet;
}

// The expected ground in image coordinates, from which residuals are computed: 1/z = -n . ray / d.
planes::CellRegions expectedRegion(const geometry::Plane3& expected, const camera::Pinhole& camera) {
  const Eigen::Vector3d w = -expected.normal / std::max(1e-3, expected.distance);
  planes::CellRegions regions;
  regions.regions.push_back({{}, {w.x() / camera.fx, w.y() / camera.fy, w.z()}});
  return regions;
}

}  // namespace

RoadSegmenter::RoadSegmenter(const RoadOptions& options) : options_(options) {
  using base::option_text::format;
  if (!(options.min_depth < options.max_depth)) {
    throw base::Error(base::ExitCode::out_of_range, "min_depth_m = " + format(options.min_depth) +
                                                        ": must be below max_depth_m = " + format(options.max_depth));
  }
}

RoadSegmentation RoadSegmenter::segment(const camera::DepthImage& image, const geometry::Plane3& expected) const {
  RoadSegmentation result;
  result.ground.width = image.width();
  result.ground.height = image.height();
  if (image.width() == 0 || image.height() == 0) return result;
  const OrganizedPoints points = backProject(image, options_.min_depth, options_.max_depth);
  const NormalImage normals = normalsOf(image, options_);
  const RoadComparator comparator{points,
                                  normals,
                                  expected.normal.cast<float>(),
                                  static_cast<float>(expected.distance),
                                  static_cast<float>(std::cos(options_.max_tilt)),
                                  static_cast<float>(options_.max_off),
                                  static_cast<float>(std::tan(options_.max_slope)),
                                  static_cast<float>(std::cos(options_.max_turn))};
  result.sure = seedsOf(connectComponents(image.width(), image.height(), comparator));
  auto barred = feetOf(normals, comparator.up);
  for (std::size_t i = 0; i < barred.size(); ++i) barred[i] |= !comparator.isNear(i);
  const planes::InverseDepth inverse = planes::invert(image, options_.min_depth, options_.max_depth);
  const double sigma = std::sqrt(options_.noise().pixelVariance());
  auto labels = road::growGround(
      inverse, image.camera(), result.sure, barred,
      {sigma, options_.grow_sigmas * sigma, options_.step_sigmas, options_.correlation_area, options_.window_radius});
  const Components components = connectComponents(labels.stride, labels.rows, SameLabel{labels.values.data()});
  result.ground = planes::describe(inverse, image.camera(), options_.noise(), expectedRegion(expected, image.camera()),
                                   std::move(labels), components,
                                   {options_.min_pixels, options_.min_hole_pixels, options_.max_depth});
  for (std::size_t i = 0; i < result.sure.size(); ++i) result.sure[i] &= result.ground.labels[i] != 0;
  return result;
}

}  // namespace omnimapper::perception
