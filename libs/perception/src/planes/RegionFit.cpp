#include "RegionFit.h"

#include <omnimapper/geometry/PlaneTangent.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "../CommonError.h"
#include "RunSums.h"

namespace omnimapper::perception::planes {

namespace {

constexpr int kNone = -1;
constexpr std::size_t kMostRegions = 65535;

// Sums over a region, of depths and of residuals from the plane of its cells.
struct RegionSums {
  PlaneMoments residuals;  // q is the residual
  double z = 0, uz = 0, vz = 0;
};

void addRun(const PixelRun& run, const InverseDepth& inverse, const camera::Pinhole& camera, const ImagePlane& plane,
            RegionSums& sums) {
  const double n = run.end - run.begin, u = run.begin - camera.cx, v = run.row - camera.cy;
  const RunSums s = sumRun(inverse.at(run.begin, run.row), run.end - run.begin, static_cast<float>(plane.at(u, v)),
                           static_cast<float>(plane.a));
  const double x = n * (n - 1) / 2, xx = x * (2 * n - 1) / 3;  // sums of 0 to n - 1 and of their squares
  PlaneMoments& m = sums.residuals;
  m.n += n;
  m.u += n * u + x;
  m.uu += n * u * u + 2 * u * x + xx;
  m.v += n * v;
  m.vv += n * v * v;
  m.uv += v * (n * u + x);
  m.q += s.r;
  m.uq += u * s.r + s.xr;
  m.vq += v * s.r;
  m.qq += s.rr;
  sums.z += s.z;
  sums.uz += u * s.z + s.xz;
  sums.vz += v * s.z;
}

// Covariance from pixel noise of the plane w, given by 1/z = w . ray with rays (u / fx, v / fy, 1).
Eigen::Matrix3d covarianceOfRayPlane(const PlaneMoments& m, const camera::Pinhole& camera, double variance) {
  const double fx = camera.fx, fy = camera.fy;
  Eigen::Matrix3d information;
  information << m.uu / (fx * fx), m.uv / (fx * fy), m.u / fx,  //
      m.uv / (fx * fy), m.vv / (fy * fy), m.v / fy,             //
      m.u / fx, m.v / fy, m.n;
  return variance * information.ldlt().solve(Eigen::Matrix3d::Identity());
}

// Covariance of w from errors that all pixels share: systematic distortion about the middle of the region, and the
// scale of depths.
Eigen::Matrix3d sharedCovariance(const Eigen::Vector3d& w, const PlaneMoments& m, const camera::Pinhole& camera,
                                 const camera::DepthNoise& noise) {
  const Eigen::Vector2d middle(m.u / (m.n * camera.fx), m.v / (m.n * camera.fy));
  Eigen::Matrix2d spread;
  spread << m.uu / (camera.fx * camera.fx), m.uv / (camera.fx * camera.fy),  //
      m.uv / (camera.fx * camera.fy), m.vv / (camera.fy * camera.fy);
  spread = spread / m.n - middle * middle.transpose();
  const CommonError distortion = commonError(spread);
  Eigen::Matrix<double, 3, 2> by_slope;  // derivative of w: a slope turns the plane about the middle
  by_slope << Eigen::Matrix2d::Identity(), -middle.transpose();
  Eigen::Matrix3d covariance = by_slope * distortion.slope * by_slope.transpose();
  covariance(2, 2) += distortion.offset;
  return noise.distortionVariance() * covariance + noise.scale * noise.scale * w * w.transpose();
}

// n . p + d = 0 for p = z ray gives 1/z = -n . ray / d: w = -n / d.
void setPlane(const ImagePlane& plane, const PlaneMoments& m, const camera::Pinhole& camera,
              const camera::DepthNoise& noise, PlaneRegion& region) {
  const Eigen::Vector3d w(plane.a * camera.fx, plane.b * camera.fy, plane.c);
  const double d = 1 / w.norm();
  const Eigen::Vector3d normal = -d * w;
  region.plane_in_sensor = {normal, d};
  Eigen::Matrix3d derivative;  // of the normal's tangent and of d, with respect to w
  derivative.topRows<2>() = -d * geometry::tangentBasis(normal).transpose();
  derivative.row(2) = d * d * normal.transpose();
  const Eigen::Matrix3d of_w =
      covarianceOfRayPlane(m, camera, noise.meanVariance()) + sharedCovariance(w, m, camera, noise);
  const Eigen::Matrix3d covariance = derivative * of_w * derivative.transpose();
  region.covariance = 0.5 * (covariance + covariance.transpose());
}

FittedRegion fit(const RegionSums& sums, const ImagePlane& of_cells, const ImagePlane& correction,
                 const camera::Pinhole& camera, const camera::DepthNoise& noise) {
  const PlaneMoments& m = sums.residuals;
  FittedRegion fitted;
  fitted.plane = {of_cells.a + correction.a, of_cells.b + correction.b, of_cells.c + correction.c};
  setPlane(fitted.plane, m, camera, noise, fitted.result);
  const Eigen::Vector3d mean = Eigen::Vector3d(sums.uz / camera.fx, sums.vz / camera.fy, sums.z) / m.n;
  const geometry::Plane3& plane = fitted.result.plane_in_sensor;
  fitted.result.centroid = mean - signedDistance(plane, mean) * plane.normal;
  fitted.result.inliers = static_cast<int>(m.n);
  return fitted;
}

// Adds the RMS distances from the fitted planes, not from the planes of the cells: the expected ground of a road may be
// far from the ground that was fitted.
void addRms(const InverseDepth& inverse, const camera::Pinhole& camera, const Components& components,
            const std::vector<int>& place, std::vector<FittedRegion>& fitted) {
  std::vector<double> squares(fitted.size(), 0);
  for (const PixelRun& run : components.runs) {
    const int i = place[static_cast<std::size_t>(run.component)];
    if (i == kNone) continue;
    const ImagePlane& plane = fitted[static_cast<std::size_t>(i)].plane;
    const double start = plane.at(run.begin - camera.cx, run.row - camera.cy);
    squares[static_cast<std::size_t>(i)] += sumRelativeSquares(inverse.at(run.begin, run.row), run.end - run.begin,
                                                               static_cast<float>(start), static_cast<float>(plane.a));
  }
  // A pixel's distance from the plane is d z times its residual in inverse depth.
  for (std::size_t i = 0; i < fitted.size(); ++i)
    fitted[i].result.rms = fitted[i].result.plane_in_sensor.distance * std::sqrt(squares[i] / fitted[i].result.inliers);
}

}  // namespace

std::vector<FittedRegion> fitRegions(const InverseDepth& inverse, const camera::Pinhole& camera,
                                     const camera::DepthNoise& noise, const Components& components,
                                     const PixelLabels& labels, const CellRegions& regions, int min_pixels) {
  std::vector<int> place(components.pixels.size(), kNone), component;
  for (std::size_t i = 0; i < components.pixels.size(); ++i) {
    if (components.pixels[i] < min_pixels) continue;
    place[i] = static_cast<int>(component.size());
    component.push_back(static_cast<int>(i));
  }
  std::vector<RegionSums> sums(component.size());
  std::vector<ImagePlane> planes(component.size());
  for (const PixelRun& run : components.runs) {
    const int i = place[static_cast<std::size_t>(run.component)];
    if (i == kNone) continue;
    const auto pixel = static_cast<std::size_t>(run.row) * static_cast<std::size_t>(labels.stride);
    const int label = labels.values[pixel + static_cast<std::size_t>(run.begin)];
    planes[static_cast<std::size_t>(i)] = regions.regions[static_cast<std::size_t>(label - 1)].plane;
    addRun(run, inverse, camera, planes[static_cast<std::size_t>(i)], sums[static_cast<std::size_t>(i)]);
  }
  std::vector<FittedRegion> fitted;
  for (std::size_t i = 0; i < component.size(); ++i) {
    const ImagePlaneFit correction = sums[i].residuals.fit();
    place[static_cast<std::size_t>(component[i])] = correction.determined ? static_cast<int>(fitted.size()) : kNone;
    if (!correction.determined) continue;
    fitted.push_back(fit(sums[i], planes[i], correction.plane, camera, noise));
    const double by_noise = sums[i].residuals.n * noise.pixelVariance();
    if (by_noise > 0) fitted.back().result.roughness = std::sqrt(correction.squares / by_noise);
    fitted.back().component = component[i];
  }
  addRms(inverse, camera, components, place, fitted);
  std::stable_sort(fitted.begin(), fitted.end(),
                   [](const FittedRegion& a, const FittedRegion& b) { return a.result.inliers > b.result.inliers; });
  // Labels have 16 bits.
  if (fitted.size() > kMostRegions) fitted.resize(kMostRegions);
  return fitted;
}

}  // namespace omnimapper::perception::planes
