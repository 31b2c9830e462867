#include "omnimapper/surfaces/levelOfSurfaces.h"

#include <omnimapper/geometry/SymmetricEigen.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace omnimapper::surfaces {

namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegree = 3.14159265358979323846 / 180;  // [rad]

// Angle [rad] of a surface with this normal from level, and from upright, if `axis` is up.
double fromLevel(const Vector3d& axis, const Vector3d& normal) {
  return std::atan2(axis.cross(normal).norm(), std::abs(axis.dot(normal)));
}
double fromUpright(const Vector3d& axis, const Vector3d& normal) {
  return std::asin(std::min(1.0, std::abs(axis.dot(normal))));
}

// Large surfaces that were seen often count for more, but no single one decides.
double weightOf(const FlatArea& area) {
  constexpr double kMost = 4, kHalf = 3;  // [m^2], measurements
  return std::min(kMost, area.area) * area.measurements / (area.measurements + kHalf);
}

// How obliquely a surface was seen, as the mean over all views of a vector in the oblique direction: length 1 at 45
// deg, 0 if it was seen head-on or from all sides. Errors of depth that grow with the distance tilt surfaces seen
// obliquely.
Vector3d slantOf(const FlatArea& area, const std::vector<Viewpoint>& viewpoints) {
  constexpr double kFarthest = 5, kAperture = 0.82;  // [m], cosine of 35 deg
  Vector3d sum = Vector3d::Zero();
  double count = 0;
  for (const auto& viewpoint : viewpoints) {
    const Vector3d ray = area.middle - viewpoint.position;
    const double distance = ray.norm(), head_on = -ray.dot(area.normal) / distance;
    if (!(distance > 1e-3) || distance > kFarthest || head_on <= 0) continue;
    if (ray.dot(viewpoint.forward) < kAperture * distance) continue;
    sum += 2 * head_on * (ray / distance + head_on * area.normal);
    ++count;
  }
  return count > 0 ? Vector3d(sum / count) : sum;
}

/// A surface with its slant, which limits how well it determines the level.
struct Weighed {
  FlatArea area;
  Vector3d slant;
};

constexpr double kSlantSigma = 2 * kDegree;  // [rad] deviation of the tilt of a surface seen at 45 deg

// Standard deviation of the angle of a level or upright surface from the vertical [rad]. Buildings deviate by about
// half a degree; surfaces seen in few views are tilted by the noise of the views and their poses; and `slant`, that
// along the axis, adds tilt.
double sigmaOf(const FlatArea& area, double slant) {
  constexpr double kBuilt = 0.4 * kDegree, kPose = 2 * kDegree, kNoise = 0.02;  // [rad], [m]
  const double of_view = std::hypot(kPose, kNoise / std::sqrt(area.area));
  return std::sqrt(kBuilt * kBuilt + of_view * of_view / area.measurements + kSlantSigma * kSlantSigma * slant * slant);
}

/// Evidence for an axis being up, as the logarithm of a likelihood.
class Evidence {
 public:
  Evidence(const std::vector<FlatArea>& areas, const std::vector<Viewpoint>& viewpoints)
      : areas_(areas), viewpoints_(viewpoints), mean_(meanOf(viewpoints)), spread_(spreadOf(viewpoints)) {}

  double of(const Vector3d& axis) const {
    return ofAngles(axis) + ofHeights(axis) + ofPictures(axis) + ofMotion(axis) + ofFloor(axis);
  }

 private:
  // Whether surfaces are level or upright; a limited penalty, because some surfaces are neither.
  double ofAngles(const Vector3d& axis) const {
    constexpr double kWidth = 3 * kDegree, kWeight = 12;
    double sum = 0, whole = 0;
    for (const auto& area : areas_) {
      const double off = std::min(fromLevel(axis, area.normal), fromUpright(axis, area.normal)) / kWidth;
      sum += weightOf(area) * (std::exp(-off * off / 2) - 1);
      whole += weightOf(area);
    }
    return kWeight * sum / whole;
  }

  // Floor and table tops are seen from above, each at its own height; there is only one ceiling, and little is seen
  // from below otherwise. A floor may slope.
  double ofHeights(const Vector3d& axis) const {
    constexpr double kSlope = 0.9, kApart = 0.15, kWhole = 0.5, kFew = 0.5, kWeight = 5;  // cosine, [m], [m^2]
    double facing_up = 0, facing_down = 0;
    for (const double sign : {1.0, -1.0}) {
      std::vector<std::pair<double, double>> heights;  // and areas
      for (const auto& area : areas_)
        if (sign * axis.dot(area.normal) > kSlope) heights.emplace_back(axis.dot(area.middle), area.area);
      std::sort(heights.begin(), heights.end());
      double sum = 0, here = 0;
      for (std::size_t i = 0; i < heights.size(); ++i) {
        here += heights[i].second;
        if (i + 1 < heights.size() && heights[i + 1].first - heights[i].first < kApart) continue;
        sum += std::min(1.0, here / kWhole);
        here = 0;
      }
      (sign > 0 ? facing_up : facing_down) = sum;
    }
    return kWeight * (facing_up - facing_down) / (facing_up + facing_down + kFew);
  }

  // Most cameras are upright, some are mounted upside down and few on their side. They look slightly down rather than
  // up, and seldom straight down.
  double ofPictures(const Vector3d& axis) const {
    constexpr double kOnItsSide = -6, kUpsideDown = -4.5, kStraightDown = -6, kLooksUp = -3;
    double sum = 0;
    for (const auto& viewpoint : viewpoints_) {
      const double up = axis.dot(viewpoint.up), forward = axis.dot(viewpoint.forward);
      const double aside = 1 - up * up - forward * forward, steep = forward * forward;
      sum += kOnItsSide * aside + (up < 0 ? kUpsideDown * up * up : 0) +
             (forward > 0 ? kLooksUp * (steep + steep * steep) : kStraightDown * steep * steep);
    }
    return viewpoints_.empty() ? 0 : sum / static_cast<double>(viewpoints_.size());
  }

  // A camera that is moved through rooms stays at one height.
  double ofMotion(const Vector3d& axis) const {
    constexpr double kFar = 1.5, kWeight = -4;  // [m]
    const double largest = std::sqrt(std::max(0.0, spread_.trace()));
    if (largest < 1e-6) return 0;
    return kWeight * axis.dot(spread_ * axis) / (largest * largest) * std::min(1.0, largest / kFar);
  }

  // A camera in the hand or on a robot is not much more than two metres above the lowest surface that it sees from
  // above.
  double ofFloor(const Vector3d& axis) const {
    constexpr double kSlope = 0.9, kLarge = 0.5, kHighest = 2.2, kSigma = 0.5, kMost = -3;  // cosine, [m^2], [m], [m]
    double height = 0;
    for (const auto& area : areas_) {
      if (area.area < kLarge || axis.dot(area.normal) < kSlope) continue;
      if (!viewpoints_.empty()) height = std::max(height, axis.dot(mean_ - area.middle));
    }
    const double off = std::max(0.0, height - kHighest) / kSigma;
    return std::max(kMost, -off * off / 2);
  }

  static Vector3d meanOf(const std::vector<Viewpoint>& viewpoints) {
    Vector3d mean = Vector3d::Zero();
    for (const auto& viewpoint : viewpoints) mean += viewpoint.position / static_cast<double>(viewpoints.size());
    return mean;
  }

  static Matrix3d spreadOf(const std::vector<Viewpoint>& viewpoints) {
    Matrix3d spread = Matrix3d::Zero();
    if (viewpoints.empty()) return spread;
    const Vector3d mean = meanOf(viewpoints);
    for (const auto& viewpoint : viewpoints)
      spread += (viewpoint.position - mean) * (viewpoint.position - mean).transpose();
    return spread / static_cast<double>(viewpoints.size());
  }

  const std::vector<FlatArea>& areas_;
  const std::vector<Viewpoint>& viewpoints_;
  Vector3d mean_;  // of the viewpoints [m]
  Matrix3d spread_;
};

// Two directions at right angles to an axis and to each other.
Eigen::Matrix<double, 3, 2> tangentOf(const Vector3d& axis) {
  Eigen::Matrix<double, 3, 2> tangent;
  tangent.col(0) = axis.unitOrthogonal();
  tangent.col(1) = axis.cross(tangent.col(0));
  return tangent;
}

/// An axis that was refined by least squares over the surfaces.
struct Refined {
  Vector3d axis;
  Matrix2d covariance = Matrix2d::Identity();  ///< [rad^2]
  double explained = 0;                        ///< [m^2] of surfaces that are level or upright
};

// Residual of one surface [rad] and its derivative by the axis.
struct Residual {
  bool is_level = false;
  double sigma = 1;
  Vector2d value = Vector2d::Zero();
  Matrix2d jacobian = Matrix2d::Zero();  // the second row is zero for an upright surface
};

Residual residualOf(const Weighed& surface, const Vector3d& axis, const Eigen::Matrix<double, 3, 2>& tangent) {
  Residual residual;
  const Vector3d& normal = surface.area.normal;
  residual.is_level = fromLevel(axis, normal) < fromUpright(axis, normal);
  if (residual.is_level) {
    residual.value = tangent.transpose() * (axis.dot(normal) < 0 ? normal : Vector3d(-normal));
    residual.jacobian.setIdentity();
    residual.sigma = sigmaOf(surface.area, surface.slant.norm());
  } else {
    residual.value.x() = axis.dot(normal);
    residual.jacobian.row(0) = (tangent.transpose() * normal).transpose();
    residual.sigma = sigmaOf(surface.area, surface.slant.dot(axis));
  }
  return residual;
}

// Robust scale of residuals given in standard deviations, limited to 1 to 3: their weighted median divided by that of a
// normal distribution.
double scaleOf(std::vector<std::pair<double, double>> residuals) {  // and their weights
  std::sort(residuals.begin(), residuals.end());
  double whole = 0, below = 0;
  for (const auto& one : residuals) whole += one.second;
  for (const auto& [size, weight] : residuals) {
    below += weight;
    if (below >= whole / 2) return std::clamp(size / 0.6745, 1.0, 3.0);
  }
  return 1;
}

/// Normal equations of level or of upright surfaces.
struct Normal {
  Matrix2d information = Matrix2d::Zero();
  Vector2d gradient = Vector2d::Zero();
  double weight = 0;
  Vector3d slant = Vector3d::Zero();
};

// All level surfaces that were seen obliquely from one side are tilted alike, so many of them give no more information
// on that direction than one.
void shareSlant(Normal& level, const Eigen::Matrix<double, 3, 2>& tangent) {
  if (level.weight <= 0) return;
  constexpr double kAcross = 0.3;  // share of that variance in the other direction
  const Vector2d slant = kSlantSigma * tangent.transpose() * level.slant / level.weight;
  const Matrix2d own = level.information.inverse();
  const Matrix2d shared =
      (own + slant * slant.transpose() + kAcross * slant.squaredNorm() * Matrix2d::Identity()).inverse();
  level.gradient = shared * own * level.gradient;
  level.information = shared;
}

// Factor by which level and upright surfaces contradict each other beyond their covariances, at least 1. Unknown errors
// of the camera's calibration tilt both.
double contradictionOf(const Normal& level, const Normal& upright) {
  constexpr double kLeastInformation = 1 / (10 * kDegree * 10 * kDegree);  // of a direction that counts as determined
  const auto directions = geometry::eigenOf<2>(upright.information);
  double worst = 1;
  for (int i = 0; i < 2; ++i) {
    const Vector2d direction = directions.vectors.col(i);
    const double by_upright = directions.values[i];
    const double by_level = direction.dot(level.information * direction);
    if (by_upright < kLeastInformation || by_level < kLeastInformation) continue;
    const double difference = direction.dot(level.gradient) / by_level - direction.dot(upright.gradient) / by_upright;
    worst = std::max(worst, difference * difference / (1 / by_level + 1 / by_upright));
  }
  return worst;
}

Refined refined(const std::vector<Weighed>& surfaces, Vector3d axis) {
  constexpr double kGate = 8 * kDegree, kTukey = 4.685;
  constexpr int kIterations = 20;
  Refined best{axis};
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const auto tangent = tangentOf(axis);
    std::vector<Residual> residuals;
    std::vector<std::pair<double, double>> sizes;
    for (const auto& surface : surfaces) {
      residuals.push_back(residualOf(surface, axis, tangent));
      const double size = residuals.back().value.norm();
      if (size < kGate) sizes.emplace_back(size / residuals.back().sigma, weightOf(surface.area));
    }
    const double scale = scaleOf(std::move(sizes));
    Normal level, upright;
    best.explained = 0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const Residual& residual = residuals[i];
      const double sigma = scale * residual.sigma, size = residual.value.norm(), off = size / (kTukey * sigma);
      if (off >= 1 || size >= kGate) continue;
      const double weight = (1 - off * off) * (1 - off * off) / (sigma * sigma);
      Normal& normal = residual.is_level ? level : upright;
      normal.information += weight * residual.jacobian.transpose() * residual.jacobian;
      normal.gradient += weight * residual.jacobian.transpose() * residual.value;
      normal.slant += weight * surfaces[i].slant;
      normal.weight += weight;
      best.explained += surfaces[i].area.area;
    }
    shareSlant(level, tangent);
    constexpr double kPrior = 1 / (30 * kDegree * 30 * kDegree);  // holds directions that no surface determines
    best.axis = axis;
    best.covariance = (level.information + upright.information + kPrior * Matrix2d::Identity()).inverse();
    const Vector2d step = -best.covariance * (level.gradient + upright.gradient);
    best.covariance *= contradictionOf(level, upright);
    axis = (axis + tangent * step).normalized();
    if (step.norm() < 1e-9) break;
  }
  return best;
}

bool isUsable(const FlatArea& area) {
  constexpr double kLeast = 0.1, kMost = 1e6;  // [m^2]
  return area.normal.allFinite() && area.middle.allFinite() && std::abs(area.normal.norm() - 1) < 1e-3 &&
         area.area >= kLeast && area.area < kMost && area.measurements > 0;
}

bool isUsable(const Viewpoint& viewpoint) {
  return viewpoint.position.allFinite() && viewpoint.up.allFinite() && viewpoint.forward.allFinite() &&
         std::abs(viewpoint.up.norm() - 1) < 1e-3 && std::abs(viewpoint.forward.norm() - 1) < 1e-3;
}

template <class Item>
std::vector<Item> usable(const std::vector<Item>& all) {
  std::vector<Item> some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some), [](const Item& one) { return isUsable(one); });
  return some;
}

// Candidates for up, in both senses: normals, cross products of normals and, for a place with a single wall, the mean
// up of the images projected to each surface.
std::vector<Vector3d> candidatesOf(const std::vector<FlatArea>& areas, const std::vector<Viewpoint>& viewpoints) {
  constexpr std::size_t kMost = 40;  // number of the largest areas that are used
  constexpr double kSame = 0.9986;   // cosine of 3 deg
  const double least_cross = std::sin(20 * kDegree);
  Vector3d held = Vector3d::Zero();
  for (const auto& viewpoint : viewpoints) held += viewpoint.up;
  std::vector<Vector3d> candidates;
  const auto add = [&](Vector3d axis) {
    axis.normalize();
    const bool is_known = std::any_of(candidates.begin(), candidates.end(),
                                      [&](const Vector3d& other) { return std::abs(other.dot(axis)) > kSame; });
    if (is_known) return;
    candidates.push_back(axis);
    candidates.push_back(-axis);
  };
  const std::size_t count = std::min(kMost, areas.size());
  for (std::size_t i = 0; i < count; ++i) add(areas[i].normal);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d along = held - held.dot(areas[i].normal) * areas[i].normal;
    if (along.norm() > 1e-3 * (1 + held.norm())) add(along);
    for (std::size_t j = 0; j < i; ++j) {
      const Vector3d cross = areas[i].normal.cross(areas[j].normal);
      if (cross.norm() > least_cross) add(cross);
    }
  }
  return candidates;
}

std::string text(const char* format, double a, double b = 0) {
  char buffer[200];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

}  // namespace

SurfacesLevel levelOfSurfaces(const std::vector<FlatArea>& all_areas, const std::vector<Viewpoint>& all_viewpoints) {
  auto areas = usable(all_areas);
  const auto viewpoints = usable(all_viewpoints);
  SurfacesLevel level;
  if (areas.empty()) {
    level.reason = "no surfaces were seen";
    return level;
  }
  std::stable_sort(areas.begin(), areas.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
  const Evidence evidence(areas, viewpoints);
  std::vector<Weighed> weighed;
  for (const auto& area : areas) weighed.push_back({area, slantOf(area, viewpoints)});
  struct Scored {
    double score;
    Vector3d axis;
  };
  std::vector<Scored> scored;
  for (const auto& axis : candidatesOf(areas, viewpoints)) scored.push_back({evidence.of(axis), axis});
  std::stable_sort(scored.begin(), scored.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  // The best few are refined, because a candidate has the error of a single surface.
  constexpr std::size_t kRefined = 12;
  std::vector<Refined> refinements;
  for (std::size_t i = 0; i < std::min(kRefined, scored.size()); ++i) {
    const Refined fine = refined(weighed, scored[i].axis);
    if (fine.axis.dot(scored[i].axis) < std::cos(10 * kDegree)) continue;
    scored[i] = {std::max(scored[i].score, evidence.of(fine.axis)), fine.axis};
  }
  std::stable_sort(scored.begin(), scored.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  constexpr double kAnother = 0.966, kLeastMargin = 2;  // cosine of 15 deg
  constexpr double kNotMuch = 6 * kDegree;
  const Refined best = refined(weighed, scored.front().axis);
  const auto second = std::find_if(scored.begin(), scored.end(),
                                   [&](const Scored& other) { return other.axis.dot(best.axis) < kAnother; });
  constexpr double kLargestMargin = 20;
  level.margin =
      second == scored.end() ? kLargestMargin : std::min(kLargestMargin, scored.front().score - second->score);
  const auto tangent = tangentOf(best.axis);
  constexpr double kFloor = 0.15 * kDegree;  // shared by all surfaces: drift of the map, calibration of the camera
  const Matrix2d of_axis = best.covariance + kFloor * kFloor * Matrix2d::Identity();
  Matrix3d turn;  // maps a change of the axis to a rotation vector
  turn << 0, -best.axis.z(), best.axis.y(), best.axis.z(), 0, -best.axis.x(), -best.axis.y(), best.axis.x(), 0;
  level.covariance = turn * tangent * of_axis * tangent.transpose() * turn.transpose();
  const double sigma = std::sqrt(geometry::eigenvaluesOf<2>(of_axis).maxCoeff());
  double whole = 0;
  for (const auto& area : areas) whole += area.area;
  if (level.margin < kLeastMargin) {
    level.reason = text("by the surfaces seen, two directions of up that are %.0f deg apart are about equally likely",
                        std::acos(std::clamp(second->axis.dot(best.axis), -1.0, 1.0)) / kDegree);
  } else if (sigma > kNotMuch) {
    level.reason = "all surfaces seen are parallel to one direction, and the tilt of up about it is not determined";
  } else {
    level.up = best.axis;
    level.reason = text("%.1f of %.1f m^2 of surfaces are level or upright", best.explained, whole) +
                   text(", the next best direction is less likely by e^%.1f", level.margin);
  }
  return level;
}

}  // namespace omnimapper::surfaces
