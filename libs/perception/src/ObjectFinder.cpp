#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/SymmetricEigen.h>
#include <omnimapper/perception/ObjectFinder.h>
#include <omnimapper/perception/SameLabel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "DepthSensor.h"
#include "objects/ConvexParts.h"
#include "objects/Fragments.h"
#include "objects/NonPlanarPoints.h"
#include "objects/OrientedBox.h"
#include "objects/Surfaces.h"

namespace omnimapper::perception {

const base::OptionTable<ObjectOptions>& ObjectOptions::table() {
  using Options = ObjectOptions;
  using base::Range;
  static const auto table =
      base::OptionTable<Options>()
          .choice<Options::Comparator>(
              "comparator", &Options::comparator,
              {{"euclidean", Options::Comparator::euclidean}, {"locally_convex", Options::Comparator::locally_convex}},
              "Neighbouring surface patches belong to one object if they are near each other. With "
              "locally_convex, objects also end where their border with what is beside them is concave all in all.")
          .number(
              "concave_angle_deg", &Options::concave_angle, {1, 180},
              "Angle between two faces that meet at a concave edge. With locally_convex, sharper concave edges speak "
              "for two objects and others for one.")
          .number("min_surface_area_m2", &Options::min_surface_area, Range::positive(),
                  "Planes at least this large belong to the environment, smaller ones to the objects in it.")
          .number("max_tilt_deg", &Options::max_tilt, {0, 180},
                  "Largest tilt from level of a surface that objects can stand on. What is level follows from the "
                  "sensor's pose on the base.")
          .number("coplanar_angle_deg", &Options::coplanar_angle, {0, 90},
                  "Largest angle between the normals of planes that may be pieces of one surface.")
          .number("coplanar_distance_m", &Options::coplanar_distance, Range::notNegative(),
                  "Two planes can be pieces of one surface only if the middle of each is at most this far from the "
                  "other plane, apart from the sensor's systematic distortion.")
          .number("min_height_m", &Options::min_height, Range::notNegative(),
                  "Points that are above a surface by less than the sum of this and the noise belong to the surface "
                  "itself.")
          .number("max_gap_m", &Options::max_gap, Range::notNegative(),
                  "Neighbouring pixels belong to different objects if their points are farther apart than the sum of "
                  "this and the noise.")
          .number("max_standing_gap_m", &Options::max_standing_gap, Range::notNegative(),
                  "Largest distance between a surface and the lowest visible point of an object on it. It is not zero, "
                  "because nearer objects may hide the foot of an object.")
          .integer("min_points", &Options::min_points, {1, 1e9}, "Clusters of fewer points than this are dropped.")
          .number("min_size_m", &Options::min_size, Range::notNegative(),
                  "Clusters of points are dropped if the longest side of their bounding box is shorter than this.")
          .number("max_volume_m3", &Options::max_volume, Range::positive(),
                  "Clusters of points are dropped if the volume of their bounding box is larger than this.")
          .number("max_aspect_ratio", &Options::max_aspect_ratio, {1, std::numeric_limits<double>::infinity()},
                  "Clusters of points longer than 0.35 m are dropped if their bounding box is more than this times as "
                  "long as its second longest side, as legs of tables, rails and plinths are.")
          .flag("on_surfaces_only", &Options::on_surfaces_only,
                "Drops clusters of points that do not stand on a level surface.");
  return table;
}

namespace {

using objects::Surface;

constexpr double kNoiseSigmas = 3;  // largest deviation that noise may cause
constexpr double kLowest = 0.02;    // share of an object's points that may be noise below the rest
constexpr double kFoot = 0.03;      // [m] height of an object's foot, beside the noise, that may be lost in the surface
constexpr std::size_t kSample = 4096;  // most points that determine a cluster's surface, axes and covariance
constexpr double kHullMargin = 0.05;   // [m] an object at the edge of a table hides where the table ends

Eigen::Vector3f pointOf(int pixel, const OrganizedPoints& all) {
  const auto i = static_cast<std::size_t>(pixel);
  return {all.x[i], all.y[i], all.z[i]};
}

using Clusters = std::vector<std::vector<int>>;  // pixels, ascending

Clusters pixelsOf(const std::vector<std::int32_t>& labels) {
  Clusters clusters;
  const auto end = static_cast<int>(labels.size());
  const SameLabel<std::int32_t> same{labels.data()};
  for (int begin = beginOfRun(same, 0, end); begin < end; begin = beginOfRun(same, begin, end)) {
    const auto cluster = static_cast<std::size_t>(labels[static_cast<std::size_t>(begin)] - 1);
    if (cluster >= clusters.size()) clusters.resize(cluster + 1);
    for (const int end_of_run = endOfRun(same, begin, end); begin < end_of_run; ++begin)
      clusters[cluster].push_back(begin);
  }
  const auto isEmpty = [](const std::vector<int>& pixels) { return pixels.empty(); };
  clusters.erase(std::remove_if(clusters.begin(), clusters.end(), isEmpty), clusters.end());
  return clusters;
}

Clusters clustersOf(const camera::DepthImage& image, const ClusterComparator& near, const ObjectOptions& options,
                    const PlaneOptions& sensor) {
  const int width = image.width(), height = image.height();
  if (options.comparator == ObjectOptions::Comparator::euclidean)
    return pixelsOf(connectComponents(width, height, near).labels(options.min_points));
  const NormalImage normals = NormalEstimator(normalsBy(sensor)).estimate(image);
  return pixelsOf(objects::convexParts(near, normals, options.concave_angle, options.min_points));
}

// At most kSample points, taken evenly from the pixels.
std::vector<Eigen::Vector3d> sampleOf(const std::vector<int>& pixels, const OrganizedPoints& all) {
  const std::size_t step = (pixels.size() - 1) / kSample + 1;
  std::vector<Eigen::Vector3d> sample;
  sample.reserve(pixels.size() / step + 1);
  for (std::size_t k = 0; k < pixels.size(); k += step) sample.push_back(pointOf(pixels[k], all).cast<double>());
  return sample;
}

objects::PointList pointsOf(const std::vector<int>& pixels, const OrganizedPoints& all) {
  objects::PointList points;
  const auto take = [&](const std::vector<float>& from, std::vector<float>& to) {
    to.reserve(pixels.size() + 1);
    to.resize(pixels.size());
    std::transform(pixels.begin(), pixels.end(), to.begin(),
                   [&](int pixel) { return from[static_cast<std::size_t>(pixel)]; });
  };
  take(all.x, points.x);
  take(all.y, points.y);
  take(all.z, points.z);
  return points;
}

Eigen::Vector3d meanOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

Eigen::Vector3d meanOf(const objects::PointList& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < points.size(); ++k) sum += points[k].cast<double>();
  return sum / static_cast<double>(points.size());
}

// Sum of v v^T, which is symmetric.
class OuterSum {
 public:
  void add(const Eigen::Vector3d& v) {
    const double x = v.x(), y = v.y(), z = v.z();
    xx_ += x * x, xy_ += x * y, xz_ += x * z, yy_ += y * y, yz_ += y * z, zz_ += z * z;
  }
  Eigen::Matrix3d matrix() const {
    Eigen::Matrix3d sum;
    sum << xx_, xy_, xz_, xy_, yy_, yz_, xz_, yz_, zz_;
    return sum;
  }

 private:
  double xx_ = 0, xy_ = 0, xz_ = 0, yy_ = 0, yz_ = 0, zz_ = 0;
};

// Covariance of the mean of `all` points, from a sample `points` and its `mean`. Noise moves each point along its ray
// independently; systematic distortion and the scale of depths move all points alike.
Eigen::Matrix3d covarianceOfMean(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& mean,
                                 std::size_t all, const camera::DepthNoise& noise) {
  const auto count = static_cast<double>(points.size());
  OuterSum independent;
  Eigen::Vector3d common = Eigen::Vector3d::Zero();
  for (const auto& point : points) {
    const Eigen::Vector3d by_inverse_depth = -point.z() * point;  // derivative of the point by 1/z
    independent.add(by_inverse_depth);
    common += by_inverse_depth / count;
  }
  return noise.meanVariance() / (count * static_cast<double>(all)) * independent.matrix() +
         noise.distortionVariance() * common * common.transpose() + noise.scale * noise.scale * mean * mean.transpose();
}

struct Standing {
  const Surface* surface = nullptr;
  double gap = 0;  // [m] between the surface and the lowest visible points
};

// The surface below the cluster that is nearest to its lowest points; none farther than `max_gap`.
Standing surfaceUnder(const std::vector<Eigen::Vector3d>& cluster, const Eigen::Vector3d& centroid,
                      const PlaneSegmentation& planes, const std::vector<Surface>& surfaces, double max_gap) {
  Standing best{nullptr, max_gap};
  std::vector<double> heights(cluster.size());
  for (const Surface& surface : surfaces) {
    const auto& plane = planes.planes[static_cast<std::size_t>(surface.plane)].plane_in_sensor;
    if (signedDistance(plane, centroid) <= 0) continue;
    if (!surface.hull.holds(surface.across.transpose() * centroid, kHullMargin)) continue;
    std::transform(cluster.begin(), cluster.end(), heights.begin(),
                   [&](const Eigen::Vector3d& point) { return signedDistance(plane, point); });
    const auto low = heights.begin() + static_cast<std::ptrdiff_t>(kLowest * static_cast<double>(heights.size()));
    std::nth_element(heights.begin(), low, heights.end());
    if (std::abs(*low) < best.gap) best = {&surface, std::abs(*low)};
  }
  return best;
}

Eigen::Vector3d leastAxisOf(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& mean) {
  OuterSum scatter;
  for (const auto& point : points) scatter.add(point - mean);
  const Eigen::Vector3d axis = geometry::eigenOf<3>(scatter.matrix()).vectors.col(0);
  return axis.dot(mean) > 0 ? Eigen::Vector3d(-axis) : axis;  // towards the sensor
}

}  // namespace

ObjectFinder::ObjectFinder(const ObjectOptions& options, const PlaneOptions& sensor)
    : options_(options), sensor_(sensor) {
  refuseDepths("objects", sensor);
  const auto refuse = [](const std::string& key, double value, const char* bound) {
    throw base::Error(base::ExitCode::out_of_range,
                      "objects: " + key + " = " + base::option_text::format(value) + ": must be " + bound);
  };
  if (options.min_points < 1) refuse("min_points", options.min_points, ">= 1");
  const std::pair<const char*, double> lengths[] = {{"coplanar_distance_m", options.coplanar_distance},
                                                    {"min_height_m", options.min_height},
                                                    {"max_gap_m", options.max_gap},
                                                    {"max_standing_gap_m", options.max_standing_gap},
                                                    {"min_size_m", options.min_size}};
  for (const auto& [key, value] : lengths) {
    if (!(value >= 0 && std::isfinite(value))) refuse(key, value, ">= 0");
  }
  if (!(options.concave_angle > 0)) refuse("concave_angle_deg", options.concave_angle, "> 0");
  if (!(options.max_aspect_ratio >= 1)) refuse("max_aspect_ratio", options.max_aspect_ratio, ">= 1");
  const std::pair<const char*, double> sizes[] = {{"min_surface_area_m2", options.min_surface_area},
                                                  {"max_volume_m3", options.max_volume}};
  for (const auto& [key, value] : sizes) {
    if (!(value > 0)) refuse(key, value, "> 0");
  }
}

bool ObjectFinder::hasSurface(const PlaneSegmentation& planes, const Eigen::Vector3d& up) const {
  return !objects::findSurfaces(planes, options_, sensor_.distortion_at_1m, up).empty();
}

std::vector<ObjectRegion> ObjectFinder::find(const camera::DepthImage& image, const PlaneSegmentation& planes,
                                             const Eigen::Vector3d& up) const {
  std::vector<ObjectRegion> found;
  if (image.width() == 0 || image.height() == 0) return found;
  if (planes.width != image.width() || planes.height != image.height())
    throw base::Error(base::ExitCode::unreadable_input, "objects: the planes are not those of this depth image");
  const OrganizedPoints points = backProject(image, sensor_.min_depth, sensor_.max_depth);
  const auto surfaces = objects::findSurfaces(planes, options_, sensor_.distortion_at_1m, up);
  const auto of_place = objects::labelsOfThePlace(planes, options_, sensor_.distortion_at_1m, surfaces);
  const auto noise = static_cast<float>(kNoiseSigmas * sensor_.noise_at_1m);
  const auto labels = objects::assignToSurfaces(planes, points, surfaces, of_place,
                                                {static_cast<float>(options_.min_height), noise, kHullMargin});
  const ClusterComparator near{points, labels, of_place, static_cast<float>(options_.max_gap), noise};
  const auto upright = objects::uprightPlanesOfThePlace(planes, of_place, surfaces);
  const objects::FragmentBounds on_plane{options_.coplanar_distance,
                                         kNoiseSigmas * sensor_.noise_at_1m + sensor_.distortion_at_1m};

  for (auto& pixels : clustersOf(image, near, options_, sensor_)) {
    const auto sample = sampleOf(pixels, points);
    const Eigen::Vector3d middle = meanOf(sample);
    const auto [surface, gap] = surfaceUnder(sample, middle, planes, surfaces, options_.max_standing_gap);
    if (surface == nullptr && options_.on_surfaces_only) continue;
    if (objects::isRestOfPlane(sample, upright, on_plane)) continue;
    const auto* const under =
        surface == nullptr ? nullptr : &planes.planes[static_cast<std::size_t>(surface->plane)].plane_in_sensor;
    const Eigen::Vector3d axis = under == nullptr ? leastAxisOf(sample, middle) : under->normal;
    auto box = objects::boxAlong(axis, sample);
    if (box.size.prod() > options_.max_volume) continue;  // the box of all points is no smaller

    auto cluster = pointsOf(pixels, points);
    ObjectRegion region;
    region.centroid = meanOf(cluster);
    region.covariance = covarianceOfMean(sample, middle, pixels.size(), sensor_.noise());
    if (under != nullptr) {
      region.surface = surface->plane;
      // The box is extended down to the surface if the foot of the object may be lost in the surface.
      const double foot = kFoot + kNoiseSigmas * sensor_.noise_at_1m * region.centroid.z() * region.centroid.z();
      const Eigen::Vector3d below = region.centroid - signedDistance(*under, region.centroid) * under->normal;
      if (gap < foot) cluster.push_back(below.cast<float>());
    }
    box = objects::extended(box, cluster);
    if (box.size.maxCoeff() < options_.min_size || box.size.prod() > options_.max_volume) continue;
    if (objects::isRod(box.size, options_.max_aspect_ratio)) continue;
    region.sensor_from_box = box.frame_from_box;
    region.box_size = box.size;
    region.pixels = std::move(pixels);
    found.push_back(std::move(region));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const ObjectRegion& a, const ObjectRegion& b) { return a.pixels.size() > b.pixels.size(); });
  return found;
}

}  // namespace omnimapper::perception
