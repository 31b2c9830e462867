#include <omnimapper/base/Error.h>
#include <omnimapper/matching/CloudSource.h>
#include <omnimapper/perception/EdgeDetector.h>
#include <omnimapper/perception/Normals.h>
#include <omnimapper/perception/OrganizedPoints.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace omnimapper::matching {

using camera::DepthImage;

const base::OptionTable<CloudSourceOptions>& CloudSourceOptions::table() {
  using Options = CloudSourceOptions;
  static const auto table =
      base::OptionTable<Options>()
          .choice("source", &Options::source,
                  {{"occluding_edges", CloudSource::occluding_edges},
                   {"rgb_edges", CloudSource::rgb_edges},
                   {"high_curvature_edges", CloudSource::high_curvature_edges},
                   {"voxels", CloudSource::voxels},
                   {"all_points", CloudSource::all_points}},
                  "Points of a depth image that are matched: those at edges of one kind (occluding: at depth "
                  "discontinuities; rgb: in the picture; high_curvature: where surfaces meet at an angle), one for "
                  "each voxel, or all.")
          .number("voxel_m", &Options::voxel, base::Range{0.001, 10},
                  "With source = voxels, side of the cubes (voxels) in each of which the points are averaged.")
          .number("max_depth_m", &Options::max_depth, base::Range{0.3, 100}, "Points with a larger depth are left out.")
          .number("point_sigma_px", &Options::pixel_noise, base::Range::positive(),
                  "Standard deviation of a point's position in the image.");
  return table;
}

perception::EdgeOptions CloudSourceOptions::easilyFound() {
  perception::EdgeOptions edges;
  edges.min_turn = 15 * base::option_text::kRadiansPerDegree;
  edges.turn_sigmas = 1.2;
  edges.min_turn_pixels = 2;
  return edges;
}

namespace {

// Covariance of the point of a pixel.
class PointNoise {
 public:
  PointNoise(const camera::Pinhole& camera, const CloudSourceOptions& options)
      : across_(static_cast<float>(options.pixel_noise / camera.fx)),
        along_(static_cast<float>(std::sqrt(options.noise.pixelVariance()))) {}
  Eigen::Matrix3f of(const Eigen::Vector3f& point) const {
    const float across = across_ * point.z(), along = along_ * point.z();  // of (x/z, y/z, 1), which is a point / z
    return across * across * Eigen::Matrix3f::Identity() + along * along * point * point.transpose();
  }

 private:
  float across_, along_;  // [1], [1/m]
};

unsigned kindOf(CloudSource source) {
  return source == CloudSource::occluding_edges ? perception::kOccluding
         : source == CloudSource::rgb_edges     ? perception::kRgb
                                                : perception::kHighCurvature;
}

perception::EdgeOptions edgeOptions(const CloudSourceOptions& options) {
  perception::EdgeOptions edges = options.edges;
  edges.jumps = options.source == CloudSource::occluding_edges;
  edges.rgb = options.source == CloudSource::rgb_edges;
  edges.high_curvature = options.source == CloudSource::high_curvature_edges;
  edges.max_depth = options.max_depth;
  return edges;
}

// Points of edge pixels. Their covariances include the spread of the pixels of the same edge around them, which is long
// along the edge.
CloudPoints edgesOf(const DepthImage& depth, const camera::ColourImage* colour, const CloudSourceOptions& options) {
  const perception::EdgeDetector detector(edgeOptions(options));
  if (options.source == CloudSource::rgb_edges && colour == nullptr)
    throw base::Error(base::ExitCode::unreadable_input, "edges of the picture are requested, but there is no picture");
  const auto edges =
      options.source == CloudSource::rgb_edges ? detector.detect(depth, *colour) : detector.detect(depth);
  const unsigned kind = kindOf(options.source);
  const int width = edges.width, height = edges.height;
  CloudPoints cloud;
  cloud.points = perception::edgePoints(edges, depth, kind);
  std::vector<std::int32_t> index(edges.labels.size(), -1);
  std::vector<std::int32_t> pixels;
  for (std::size_t i = 0; i < edges.labels.size(); ++i) {
    if ((edges.labels[i] & kind) == 0) continue;
    index[i] = static_cast<std::int32_t>(pixels.size());
    pixels.push_back(static_cast<std::int32_t>(i));
  }
  constexpr int kReach = 4;        // [px] of the window
  constexpr float kApart = 0.05F;  // relative difference in depth beyond which a pixel is of another edge
  const PointNoise noise(depth.camera(), options);
  cloud.covariances.reserve(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const int u = pixels[i] % width, v = pixels[i] / width;
    const Eigen::Vector3f& here = cloud.points[i];
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();
    float count = 0;
    for (int y = std::max(0, v - kReach); y <= std::min(height - 1, v + kReach); ++y) {
      const std::int32_t* row = index.data() + static_cast<std::ptrdiff_t>(y) * width;
      for (int x = std::max(0, u - kReach); x <= std::min(width - 1, u + kReach); ++x) {
        if (row[x] < 0) continue;
        const Eigen::Vector3f off = cloud.points[static_cast<std::size_t>(row[x])] - here;
        if (std::abs(off.z()) > kApart * here.z()) continue;
        sum += off;
        squares += off * off.transpose();
        ++count;
      }
    }
    cloud.covariances.push_back(noise.of(here) + static_cast<float>(options.edge_slide * options.edge_slide) *
                                                     (squares / count - sum * sum.transpose() / (count * count)));
  }
  return cloud;
}

// Covariance of a point on a surface: the next point may be `spacing` away along the surface; across it there is only
// the noise.
Eigen::Matrix3f onSurface(const Eigen::Vector3f& normal, float spacing, const Eigen::Matrix3f& noise) {
  if (!normal.allFinite()) return noise + spacing * spacing * Eigen::Matrix3f::Identity();
  return noise + spacing * spacing * (Eigen::Matrix3f::Identity() - normal * normal.transpose());
}

struct Surface {
  perception::OrganizedPoints points;
  perception::NormalImage normals;
  Eigen::Vector3f point(std::size_t i) const { return {points.x[i], points.y[i], points.z[i]}; }
  Eigen::Vector3f normal(std::size_t i) const { return {normals.x()[i], normals.y()[i], normals.z()[i]}; }
};

Surface surfaceOf(const DepthImage& depth, const CloudSourceOptions& options) {
  static const perception::NormalEstimator estimator{perception::NormalOptions{}};
  return {perception::backProject(depth, 0, options.max_depth), estimator.estimate(depth)};
}

CloudPoints allOf(const DepthImage& depth, const CloudSourceOptions& options) {
  const Surface surface = surfaceOf(depth, options);
  const PointNoise noise(depth.camera(), options);
  CloudPoints cloud;
  for (std::size_t i = 0; i < surface.points.z.size(); ++i) {
    if (!std::isfinite(surface.points.z[i])) continue;
    const Eigen::Vector3f point = surface.point(i), normal = surface.normal(i);
    cloud.points.push_back(point);
    cloud.normals.push_back(normal);
    cloud.covariances.push_back(onSurface(normal, static_cast<float>(options.slide), noise.of(point)));
  }
  return cloud;
}

// The sums of the points in each cube, in the order in which the cubes were met.
class VoxelSums {
 public:
  struct Sum {
    std::int64_t key;
    Eigen::Vector3f points = Eigen::Vector3f::Zero(), normals = Eigen::Vector3f::Zero();
    float count = 0, with_normal = 0;
  };
  VoxelSums(double side, std::size_t points) : per_metre_(static_cast<float>(1 / side)) {
    std::size_t slots = 1024;
    while (slots < 2 * points) slots *= 2;
    slots_.assign(slots, -1);
  }
  Sum& at(const Eigen::Vector3f& point) {
    const auto cell = [&](float x) { return static_cast<std::int64_t>(std::floor(x * per_metre_)) & 0x1fffff; };
    const std::int64_t key = cell(point.x()) | cell(point.y()) << 21 | cell(point.z()) << 42;
    auto slot = static_cast<std::uint64_t>(key) * 0x9e3779b97f4a7c15U >> 20 & (slots_.size() - 1);
    while (slots_[slot] >= 0 && sums_[static_cast<std::size_t>(slots_[slot])].key != key)
      slot = (slot + 1) & (slots_.size() - 1);
    if (slots_[slot] < 0) {
      slots_[slot] = static_cast<std::int32_t>(sums_.size());
      sums_.push_back({key});
    }
    return sums_[static_cast<std::size_t>(slots_[slot])];
  }
  const std::vector<Sum>& sums() const { return sums_; }

 private:
  float per_metre_;
  std::vector<std::int32_t> slots_;
  std::vector<Sum> sums_;
};

CloudPoints voxelsOf(const DepthImage& depth, const CloudSourceOptions& options) {
  const Surface surface = surfaceOf(depth, options);
  VoxelSums voxels(options.voxel, surface.points.z.size());
  for (std::size_t i = 0; i < surface.points.z.size(); ++i) {
    if (!std::isfinite(surface.points.z[i])) continue;
    const Eigen::Vector3f point = surface.point(i), normal = surface.normal(i);
    auto& sum = voxels.at(point);
    sum.points += point;
    ++sum.count;
    if (!normal.allFinite()) continue;
    sum.normals += normal;
    ++sum.with_normal;
  }
  const PointNoise noise(depth.camera(), options);
  const auto spacing = static_cast<float>(options.slide);
  CloudPoints cloud;
  for (const auto& sum : voxels.sums()) {
    const Eigen::Vector3f point = sum.points / sum.count;
    const float length = sum.normals.norm();
    // If its normals do not agree, a cube has no normal.
    const Eigen::Vector3f normal = length > 0.8F * sum.with_normal && sum.with_normal > 0
                                       ? Eigen::Vector3f(sum.normals / length)
                                       : Eigen::Vector3f::Constant(std::nanf(""));
    cloud.points.push_back(point);
    cloud.normals.push_back(normal);
    cloud.covariances.push_back(onSurface(normal, spacing, noise.of(point) / std::min(sum.count, 9.0F)));
  }
  return cloud;
}

}  // namespace

CloudPoints cloudOf(const DepthImage& depth, const camera::ColourImage* colour, const CloudSourceOptions& options) {
  if (options.source == CloudSource::voxels) return voxelsOf(depth, options);
  if (options.source == CloudSource::all_points) return allOf(depth, options);
  return edgesOf(depth, colour, options);
}

}  // namespace omnimapper::matching
