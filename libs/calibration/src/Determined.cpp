#include "Determined.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace omnimapper::calibration {

namespace {

constexpr double kDegree = base::option_text::kRadiansPerDegree;

const std::vector<std::string>& keysOf(Group group) {
  static const std::map<Group, std::vector<std::string>> keys{
      {Group::focal, {"fx_px", "fy_px"}},
      {Group::centre, {"cx_px", "cy_px"}},
      {Group::lens, {"k1", "k2", "p1", "p2", "k3"}},
      {Group::depth_focal, {"fx_px", "fy_px"}},
      {Group::depth_centre, {"cx_px", "cy_px"}},
      {Group::place, {"right_m", "down_m", "forward_m"}},
      {Group::turn, {"about_right_deg", "about_down_deg", "about_forward_deg"}},
      {Group::scale, {"depth_scale"}},
      {Group::timing, {"picture_readout_s", "depth_readout_s", "depth_delay_s"}}};
  return keys.at(group);
}

std::vector<double> valuesOf(Group group, const DepthCamera& camera) {
  const auto& p = camera.picture;
  const auto& d = camera.depth;
  const Eigen::Vector3d& place = camera.depth_from_picture.translation;
  const Eigen::Vector3d turn = geometry::logSo3(camera.depth_from_picture.rotation) / kDegree;
  switch (group) {
    case Group::focal:
      return {p[0], p[1]};
    case Group::centre:
      return {p[2], p[3]};
    case Group::lens:
      return {p[4], p[5], p[6], p[7], p[8]};
    case Group::depth_focal:
      return {d[0], d[1]};
    case Group::depth_centre:
      return {d[2], d[3]};
    case Group::place:
      return {place.x(), place.y(), place.z()};
    case Group::turn:
      return {turn.x(), turn.y(), turn.z()};
    case Group::scale:
      return {camera.depth_scale};
    case Group::timing:
      break;
  }
  return {};
}

std::vector<std::size_t> indicesOf(Group group, const Adjusted& adjusted) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < adjusted.parameters.size(); ++i)
    if (adjusted.parameters[i].group == group) all.push_back(i);
  return all;
}

// Standard deviation of the lens distortion [px], the largest over a grid of places between the middle and the rim.
double lensSigma(const Adjusted& adjusted, const std::vector<std::size_t>& indices) {
  const auto& camera = adjusted.estimate.camera;
  constexpr double kShare = 0.35;  // distance of the grid from the middle, as a share of width and height
  constexpr double kStep = 1e-6;
  Eigen::MatrixXd covariance(5, 5);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      covariance(i, j) = adjusted.covariance(static_cast<Eigen::Index>(indices[static_cast<std::size_t>(i)]),
                                             static_cast<Eigen::Index>(indices[static_cast<std::size_t>(j)]));
  double worst = 0;
  for (const double across : {-kShare, 0.0, kShare}) {
    for (const double down : {-kShare, 0.0, kShare}) {
      const Eigen::Vector3d ray(across * camera.width / camera.picture[0], down * camera.height / camera.picture[1], 1);
      Eigen::Matrix<double, 2, 5> derivative;
      for (int i = 0; i < 5; ++i) {
        Intrinsics changed = camera.picture;
        changed[static_cast<std::size_t>(4 + i)] += kStep;
        derivative.col(i) = (project(changed.data(), ray) - project(camera.picture.data(), ray)) / kStep;
      }
      const Eigen::Matrix2d of_place = derivative * covariance * derivative.transpose();
      worst = std::max({worst, of_place(0, 0), of_place(1, 1)});
    }
  }
  return std::sqrt(worst);
}

// Whether the radial distortion is not monotonic within the picture, so that two directions have the same pixel.
bool folds(const DepthCamera& camera) {
  const auto& c = camera.picture;
  const double corner = std::hypot(0.5 * camera.width / c[0], 0.5 * camera.height / c[1]);
  constexpr int kSteps = 50;
  double before = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const double r = corner * i / kSteps, r2 = r * r;
    const double distorted = r * (1 + r2 * (c[4] + r2 * (c[5] + r2 * c[8])));
    if (distorted <= before) return true;
    before = distorted;
  }
  return false;
}

std::string remedyOf(Group group) {
  switch (group) {
    case Group::focal:
    case Group::centre:
      return "turn the camera slowly by 30 degrees and more about each of its axes in front of objects with corners";
    case Group::lens:
      return "record corners near every edge of the picture, not only in its middle";
    case Group::depth_focal:
    case Group::depth_centre:
    case Group::place:
    case Group::turn:
      return "record slanted surfaces with corners, near and far, in every part of the image";
    case Group::timing:
      break;
    case Group::scale:
      return "record the wheels' odometry or given poses with the images, over some metres";
  }
  return "";
}

std::string reasonOf(Group group, const Adjusted* attempt, bool has_metres) {
  if (group == Group::scale && !has_metres)
    return "not determined: a larger scale and a longer distance look the same, and nothing in the log measures metres "
           "between views that are far enough apart; " +
           remedyOf(group);
  if (group == Group::scale && attempt != nullptr && undetermined(group, *attempt) <= 1)
    return "the estimate differs from the log's value by less than two standard deviations";
  if (attempt != nullptr && attempt->estimate.camera.is_registered && (group == Group::place || group == Group::turn))
    return "the depths are registered to the picture; the estimate is the remaining error, and it is not written, "
           "because the picture would have to be warped to another view";
  if (attempt == nullptr) return "not determined; " + remedyOf(group);
  if (group == Group::lens && folds(attempt->estimate.camera))
    return "not determined: the lens that fits the corners is not monotonic up to the picture's rim; " +
           remedyOf(group);
  return "not determined: the standard deviation is " + base::brief(undetermined(group, *attempt), 2) +
         " times the largest acceptable one; " + remedyOf(group);
}

}  // namespace

double undetermined(Group group, const Adjusted& adjusted) {
  // [-] [px] [px] [m] [rad] [-] Largest acceptable standard deviations, and their largest acceptable share of the
  // prior's.
  constexpr double kFocal = 0.01, kCentre = 5, kLens = 1, kPlace = 0.01, kTurn = 0.5 * kDegree, kScale = 0.02;
  constexpr double kShareOfPrior = 0.7;
  const auto indices = indicesOf(group, adjusted);
  double worst = 0;
  for (const std::size_t i : indices) {
    const auto& one = adjusted.parameters[i];
    double acceptable = 1;
    switch (group) {
      case Group::focal:
      case Group::depth_focal:
        acceptable = kFocal * one.value;
        break;
      case Group::centre:
      case Group::depth_centre:
        acceptable = kCentre;
        break;
      case Group::lens:
        acceptable = std::numeric_limits<double>::infinity();
        break;
      case Group::place:
        acceptable = kPlace;
        break;
      case Group::turn:
        acceptable = kTurn;
        break;
      case Group::scale:
        acceptable = kScale;
        break;
      case Group::timing:
        return 0;  // the timing belongs to this log's motion and is only estimated to remove its effect
    }
    worst = std::max(worst, one.sigma / acceptable);
    if (group != Group::lens) worst = std::max(worst, one.sigma / (kShareOfPrior * one.prior_sigma));
  }
  if (group == Group::lens && indices.size() == 5) {
    worst = std::max(worst, lensSigma(adjusted, indices) / kLens);
    if (folds(adjusted.estimate.camera)) worst = std::max(worst, 1.01);
  }
  return worst;
}

std::vector<GroupResult> resultsOf(const DepthCamera& log, const Adjusted& adjusted,
                                   const std::map<Group, Adjusted>& attempts, bool has_metres) {
  std::vector<Group> groups{Group::focal, Group::centre, Group::lens};
  if (!log.is_registered) groups.insert(groups.end(), {Group::depth_focal, Group::depth_centre});
  groups.insert(groups.end(), {Group::place, Group::turn, Group::scale});
  std::vector<GroupResult> results;
  for (const Group group : groups) {
    const auto found = attempts.find(group);
    const bool is_determined = !indicesOf(group, adjusted).empty();
    const Adjusted* source = is_determined ? &adjusted : found != attempts.end() ? &found->second : nullptr;
    GroupResult result{group, {}, is_determined, is_determined ? "" : reasonOf(group, source, has_metres)};
    const auto before = valuesOf(group, log), after = valuesOf(group, source ? source->estimate.camera : log);
    const auto indices = source ? indicesOf(group, *source) : std::vector<std::size_t>();
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double unit = group == Group::turn ? kDegree : 1;
      result.numbers.push_back({keysOf(group)[i], before[i], after[i],
                                i < indices.size() ? source->parameters[indices[i]].sigma / unit : 0});
    }
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace omnimapper::calibration
