#include "image/DenseReference.h"

#include <omnimapper/geometry/SymmetricEigen.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>

#include "image/Shutter.h"

namespace omnimapper::matching {

using geometry::Se3;

namespace {

struct Candidate {
  int x, y;
  float gradient_x, gradient_y;  // [1/px]
};

// Central differences; none at the border.
Candidate candidateAt(const RgbdLevel& level, int x, int y) {
  Candidate candidate{x, y, 0, 0};
  if (level.grey.empty()) return candidate;
  const float* at = level.grey.data() + level.at(x, y);
  candidate.gradient_x = 0.5F * (at[1] - at[-1]);
  candidate.gradient_y = 0.5F * (at[level.width] - at[-level.width]);
  return candidate;
}

// Chooses half of the points on a regular grid and the others where the picture changes most.
std::vector<Candidate> choose(const RgbdLevel& level, std::size_t most) {
  std::vector<Candidate> all;
  for (int y = 1; y + 1 < level.height; ++y)
    for (int x = 1; x + 1 < level.width; ++x)
      if (level.inverse_depth[level.at(x, y)] > 0) all.push_back(candidateAt(level, x, y));
  if (all.size() <= most) return all;
  const std::size_t half = level.grey.empty() ? most : std::max<std::size_t>(1, most / 2);
  const int step = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(all.size()) / static_cast<double>(half))));
  const auto isOnGrid = [step](const Candidate& c) { return c.x % step == 0 && c.y % step == 0; };
  const auto strength = [](const Candidate& c) { return c.gradient_x * c.gradient_x + c.gradient_y * c.gradient_y; };
  std::vector<Candidate> chosen;
  std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), isOnGrid);
  if (chosen.size() >= most || level.grey.empty()) return chosen;
  std::vector<float> strengths;
  for (const auto& candidate : all)
    if (!isOnGrid(candidate)) strengths.push_back(strength(candidate));
  const std::size_t rest = most - chosen.size();
  if (rest < strengths.size()) {
    std::nth_element(strengths.begin(), strengths.begin() + static_cast<std::ptrdiff_t>(rest), strengths.end(),
                     std::greater<>());
    const float least = strengths[rest];
    for (const auto& candidate : all)
      if (!isOnGrid(candidate) && strength(candidate) > least) chosen.push_back(candidate);
  }
  return chosen;
}

/// The plane that the surface around a pixel lies on.
struct SurfacePlane {
  Eigen::Vector3d normal;  // unit, towards the camera
  double sigma;            // [rad] of the normal, by the residuals of the pixels around
};

/// The normal equations of a plane through pixels around one, whose inverse depths are linear in the image.
struct PlaneEquations {
  explicit PlaneEquations(const Eigen::Matrix3d& squares) : solver(squares), inverse(squares.inverse()) {}

  Eigen::LDLT<Eigen::Matrix3d> solver;
  Eigen::Matrix3d inverse;
};

// Those of all pixels of a window; most windows lie within one surface.
const PlaneEquations& equationsOfWindow(int radius) {
  const auto all = [](int r) {
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    for (int v = -r; v <= r; ++v)
      for (int u = -r; u <= r; ++u) squares += Eigen::Vector3d(u, v, 1) * Eigen::RowVector3d(u, v, 1);
    return PlaneEquations(squares);
  };
  static const PlaneEquations small = all(1), large = all(2);
  return radius == 1 ? small : large;
}

// Calls take(u, v, off) for each pixel (x + u, y + v) of the window that is of one surface with the middle one; `off`
// is the difference of their inverse depths.
template <class Take>
void eachOfSurface(const RgbdLevel& level, int x, int y, int radius, const Take& take) {
  constexpr float kOneSurface = 0.05F;  // largest relative difference on one surface
  const float middle = level.inverse_depth[level.at(x, y)];
  for (int v = std::max(-radius, -y); v <= radius && y + v < level.height; ++v) {
    for (int u = std::max(-radius, -x); u <= radius && x + u < level.width; ++u) {
      const float off = level.inverse_depth[level.at(x + u, y + v)] - middle;
      if (std::abs(off) <= kOneSurface * middle) take(u, v, static_cast<double>(off));
    }
  }
}

// Fits a plane through pixels of this level: inverse depth is linear in an image of a plane, 1/z = (n/d) . (x/z, y/z,
// 1). Normals of the finest level are six times as noisy, and noisy ones seem to determine motions along a bare wall.
// None where less than half of the pixels are of one surface.
std::optional<SurfacePlane> planeAround(const RgbdLevel& level, int x, int y) {
  constexpr int kCoarse = 120;  // [px] columns below which 5 x 5 pixels are too large a part of the view
  const int radius = level.width < kCoarse ? 1 : 2, pixels = (2 * radius + 1) * (2 * radius + 1);
  Eigen::Vector3d products = Eigen::Vector3d::Zero();
  double sum = 0;
  int count = 0;
  eachOfSurface(level, x, y, radius, [&](int u, int v, double off) {
    products += off * Eigen::Vector3d(u, v, 1);
    sum += off * off;
    ++count;
  });
  if (2 * count < pixels) return std::nullopt;
  std::optional<PlaneEquations> of_part;
  if (count < pixels) {
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    eachOfSurface(level, x, y, radius,
                  [&](int u, int v, double) { squares += Eigen::Vector3d(u, v, 1) * Eigen::RowVector3d(u, v, 1); });
    of_part.emplace(squares);
  }
  const PlaneEquations& equations = of_part ? *of_part : equationsOfWindow(radius);
  const Eigen::Vector3d slope = equations.solver.solve(products);
  const auto& camera = level.camera;
  const auto middle = static_cast<double>(level.inverse_depth[level.at(x, y)]);
  const double a = slope.x() * camera.fx, b = slope.y() * camera.fy;
  const double c = middle + slope.z() - slope.x() * (x - camera.cx) - slope.y() * (y - camera.cy);
  const double length = std::sqrt(a * a + b * b + c * c);
  const double variance = std::max(0.0, sum - slope.dot(products)) / (count - 3);
  const Eigen::Matrix3d of_slope = variance * equations.inverse;
  const double rough =
      std::sqrt(std::max(camera.fx * camera.fx * of_slope(0, 0), camera.fy * camera.fy * of_slope(1, 1)));
  return SurfacePlane{-Eigen::Vector3d(a, b, c) / length, rough / length};
}

/// A point, and the plane it lies on.
struct PlanePoint {
  Eigen::Vector3d point, normal;
  double sigma;  // [rad] of the normal
};

// Motions that the normals leave open: along directions in which no normals have a component above their noise and, if
// all normals are the same, a rotation about the normal.
Eigen::Matrix<double, 6, Eigen::Dynamic> openMotions(const std::vector<PlanePoint>& points) {
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const double count = std::max(1.0, static_cast<double>(points.size()));
  for (const auto& one : points) {
    normals += one.normal * one.normal.transpose() / count;
    middle += one.point / count;
  }
  const auto axes = geometry::eigenOf<3>(normals);
  std::vector<geometry::Vector6d> open;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = axes.vectors.col(i);
    // Neighbouring pixels share their errors, so normals are twice as noisy as the residuals of the planes suggest.
    constexpr double kSigmas = 4 * 2, kLeast = 0.1;  // [rad]
    constexpr double kFew = 0.003;                   // share of the points
    const auto informative = std::count_if(points.begin(), points.end(), [&](const PlanePoint& one) {
      return std::abs(one.normal.dot(axis)) > std::max(kLeast, kSigmas * one.sigma);
    });
    if (static_cast<double>(informative) > kFew * count) continue;
    open.push_back(geometry::Vector6d::Zero());
    open.back().head<3>() = axis;
  }
  // All normals are the same if they have nearly no component along the two other axes.
  constexpr double kOne = 0.9;  // share of their mean square
  if (open.size() >= 2 && axes.values[2] > kOne) {
    const Eigen::Vector3d normal = axes.vectors.col(2);
    open.push_back(geometry::Vector6d::Zero());
    open.back() << middle.cross(normal), normal;
    for (std::size_t i = 0; i + 1 < open.size(); ++i) open.back() -= open[i].dot(open.back()) * open[i];
    open.back().normalize();
  }
  Eigen::Matrix<double, 6, Eigen::Dynamic> columns(6, static_cast<Eigen::Index>(open.size()));
  for (std::size_t i = 0; i < open.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = open[i];
  return columns;
}

/// The brightness of a point in the picture, and its gradient by the point's position.
struct Shown {
  float grey;
  Eigen::Vector3f by_place;  // [1/m]
};

// None outside the picture. `point` is in the camera's frame at the middle of the depths.
std::optional<Shown> changeOf(const RgbdLevel& level, const Shutter& shutter, const Eigen::Vector3d& point) {
  const Eigen::Vector3d p = shutter.seen(point, level);
  const auto& camera = level.camera;
  if (!(p.z() > 0.05)) return std::nullopt;
  const double u = camera.fx * p.x() / p.z() + camera.cx, v = camera.fy * p.y() / p.z() + camera.cy;
  if (!(u >= 1 && v >= 1 && u < level.width - 2 && v < level.height - 2)) return std::nullopt;
  const int x = static_cast<int>(u), y = static_cast<int>(v);
  const auto right = static_cast<float>(u - x), down = static_cast<float>(v - y);
  const auto width = static_cast<std::ptrdiff_t>(level.width);
  const float* at = level.grey.data() + level.at(x, y);
  const auto between = [&](const auto& value) {
    return (1 - down) * ((1 - right) * value(at) + right * value(at + 1)) +
           down * ((1 - right) * value(at + width) + right * value(at + width + 1));
  };
  const float gx = between([](const float* g) { return 0.5F * (g[1] - g[-1]); });
  const float gy = between([width](const float* g) { return 0.5F * (g[width] - g[-width]); });
  const double ax = camera.fx * static_cast<double>(gx) / p.z(), ay = camera.fy * static_cast<double>(gy) / p.z();
  const Eigen::Vector3d in_picture(ax, ay, -(ax * p.x() + ay * p.y()) / p.z());
  return Shown{between([](const float* g) { return *g; }), in_picture.cast<float>()};
}

}  // namespace

std::shared_ptr<const DenseReference> DenseMatcher::prepare(const RgbdPyramid& image,
                                                            const CameraMotion& motion) const {
  const Shutter depth_shutter(motion, 0, motion.depth_readout);
  const Shutter picture_shutter(motion, motion.picture_delay, motion.picture_readout);
  auto reference = std::make_shared<DenseReference>();
  reference->has_picture = image.hasPicture();
  const auto& levels = image.levels();
  reference->levels.resize(levels.size());
  const std::size_t first = std::min(static_cast<std::size_t>(std::max(0, options_.finest_level)), levels.size() - 1);
  for (std::size_t l = first; l < levels.size(); ++l) {
    const RgbdLevel& level = levels[l];
    const auto& camera = level.camera;
    const auto chosen = choose(level, static_cast<std::size_t>(options_.max_points));
    auto& to = reference->levels[l];
    to.count = chosen.size();
    to.points.resize((chosen.size() + kLanes - 1) / kLanes);
    for (auto& eight : to.points) {
      for (Lanes* lanes : {&eight.x, &eight.y, &eight.nx, &eight.ny, &eight.nz, &eight.gx, &eight.gy, &eight.gz,
                           &eight.grey, &eight.is_point})
        lanes->setZero();
      eight.z.setOnes();
      eight.grey.setConstant(kNoGrey);
    }
    std::vector<PlanePoint> planes;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const Candidate& c = chosen[i];
      auto& eight = to.points[i / kLanes];
      const auto lane = static_cast<Eigen::Index>(i % kLanes);
      const std::size_t pixel = level.at(c.x, c.y);
      const float z = 1 / level.inverse_depth[pixel];
      const auto fx = static_cast<float>(camera.fx), fy = static_cast<float>(camera.fy);
      const float x = z * (static_cast<float>(c.x) - static_cast<float>(camera.cx)) / fx;
      const float y = z * (static_cast<float>(c.y) - static_cast<float>(camera.cy)) / fy;
      // Position of the point at the time when the middle row was taken.
      const double after = depth_shutter.after(c.y, level.height);
      const Eigen::Vector3d point = depth_shutter.back(Eigen::Vector3d(x, y, z), after);
      eight.x[lane] = static_cast<float>(point.x());
      eight.y[lane] = static_cast<float>(point.y());
      eight.z[lane] = static_cast<float>(point.z());
      eight.is_point[lane] = 1;
      if (const auto plane = planeAround(level, c.x, c.y)) {
        const Eigen::Vector3d normal = depth_shutter.turnedBack(plane->normal, after);
        eight.nx[lane] = static_cast<float>(normal.x());
        eight.ny[lane] = static_cast<float>(normal.y());
        eight.nz[lane] = static_cast<float>(normal.z());
        planes.push_back({point, normal, plane->sigma});
      }
      if (level.grey.empty()) continue;
      const auto change = changeOf(level, picture_shutter, point);
      if (!change) continue;
      eight.grey[lane] = change->grey;
      // Where the picture is plain its gradients are noise, and noise must not determine a motion.
      constexpr float kLeastGradient = 2;  // [1/px] in grey levels from 0 to 255
      const Eigen::Vector3f& by_place = change->by_place;
      const float per_pixel = by_place.norm() * z / fx;
      if (per_pixel < kLeastGradient) continue;
      eight.gx[lane] = change->by_place.x();
      eight.gy[lane] = change->by_place.y();
      eight.gz[lane] = change->by_place.z();
    }
    to.open = openMotions(planes);
  }
  return reference;
}

}  // namespace omnimapper::matching
