#include "Tracks.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <opencv2/features2d.hpp>

namespace omnimapper::calibration {

namespace {

constexpr int kCell = 32;  // [px] of the grid in which corners are looked up

struct Corners {
  std::vector<Eigen::Vector2d> pixels;
  std::vector<double> sigmas;
  std::vector<std::array<std::uint64_t, 4>> descriptors;
  std::vector<std::optional<Eigen::Vector3d>> points;  // in the picture's optical frame
  int columns = 0, rows = 0;
  std::vector<std::vector<std::size_t>> cells;
};

// Keeps the strongest corners of each part of the picture, because corners near the rim determine a lens better than
// many on a poster in the middle.
std::vector<cv::KeyPoint> spread(std::vector<cv::KeyPoint> all, int width, int height, std::size_t most) {
  constexpr int kColumns = 16, kRows = 12;
  std::sort(all.begin(), all.end(), [](const cv::KeyPoint& a, const cv::KeyPoint& b) {
    if (a.response != b.response) return a.response > b.response;
    return a.pt.y != b.pt.y ? a.pt.y < b.pt.y : a.pt.x < b.pt.x;
  });
  std::vector<std::vector<cv::KeyPoint>> parts(kColumns * kRows);
  for (const auto& key : all) {
    const int column = std::clamp(static_cast<int>(key.pt.x) * kColumns / width, 0, kColumns - 1);
    const int row = std::clamp(static_cast<int>(key.pt.y) * kRows / height, 0, kRows - 1);
    parts[static_cast<std::size_t>(row * kColumns + column)].push_back(key);
  }
  std::vector<cv::KeyPoint> chosen;
  for (std::size_t rank = 0; chosen.size() < most; ++rank) {
    const auto before = chosen.size();
    for (const auto& part : parts)
      if (rank < part.size() && chosen.size() < most) chosen.push_back(part[rank]);
    if (chosen.size() == before) break;
  }
  return chosen;
}

Corners cornersOf(const CalibrationView& view, const DepthCamera& camera) {
  constexpr int kDetected = 6000, kLevels = 5, kEdge = 16, kFastThreshold = 8;
  constexpr std::size_t kMost = 800;
  constexpr float kScale = 1.2F;
  constexpr double kSigma = 0.7;  // [px] of a corner at the finest level
  Corners corners;
  corners.columns = view.width / kCell + 1;
  corners.rows = view.height / kCell + 1;
  corners.cells.resize(static_cast<std::size_t>(corners.columns * corners.rows));
  if (std::min(view.width, view.height) <= 4 * kEdge) return corners;
  const cv::Mat grey(view.height, view.width, CV_8UC1, const_cast<std::uint8_t*>(view.grey.data()));
  const auto orb = cv::ORB::create(kDetected, kScale, kLevels, kEdge, 0, 2, cv::ORB::HARRIS_SCORE, 31, kFastThreshold);
  std::vector<cv::KeyPoint> keys;
  orb->detect(grey, keys);
  keys = spread(std::move(keys), view.width, view.height, kMost);
  cv::Mat rows;
  orb->compute(grey, keys, rows);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Eigen::Vector2d pixel(static_cast<double>(keys[i].pt.x), static_cast<double>(keys[i].pt.y));
    corners.pixels.push_back(pixel);
    corners.sigmas.push_back(kSigma * std::pow(static_cast<double>(kScale), keys[i].octave));
    corners.descriptors.emplace_back();
    std::memcpy(corners.descriptors.back().data(), rows.ptr(static_cast<int>(i)), 32);
    corners.points.push_back(pointAt(view, camera, pixel));
    const int column = static_cast<int>(pixel.x()) / kCell, row = static_cast<int>(pixel.y()) / kCell;
    corners.cells[static_cast<std::size_t>(row * corners.columns + column)].push_back(i);
  }
  return corners;
}

int distance(const std::array<std::uint64_t, 4>& a, const std::array<std::uint64_t, 4>& b) {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += std::bitset<64>(a[i] ^ b[i]).count();
  return static_cast<int>(sum);
}

// The corner near a place with the most similar descriptor; none if another one there is nearly as similar.
std::optional<std::size_t> likestNear(const Corners& corners, const Eigen::Vector2d& place,
                                      const std::array<std::uint64_t, 4>& descriptor) {
  constexpr double kGate = 28, kRatio = 0.8;  // [px] wide enough for a focal length that is 5 % off
  constexpr int kFarthest = 64;               // of 256 bits
  const int left = std::max(0, static_cast<int>(place.x() - kGate) / kCell);
  const int top = std::max(0, static_cast<int>(place.y() - kGate) / kCell);
  const int right = std::min(corners.columns - 1, static_cast<int>(place.x() + kGate) / kCell);
  const int bottom = std::min(corners.rows - 1, static_cast<int>(place.y() + kGate) / kCell);
  std::size_t best = 0;
  int least = 257, second = 257;
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) {
      for (const std::size_t i : corners.cells[static_cast<std::size_t>(row * corners.columns + column)]) {
        if ((corners.pixels[i] - place).norm() > kGate) continue;
        const int one = distance(corners.descriptors[i], descriptor);
        if (one < least) {
          second = least;
          least = one;
          best = i;
        } else {
          second = std::min(second, one);
        }
      }
    }
  }
  if (least > kFarthest || least > kRatio * second) return std::nullopt;
  return best;
}

using Links = std::vector<std::size_t>;  // for each corner of one view the index of the other's, or kNone
constexpr auto kNone = static_cast<std::size_t>(-1);

Links linksTo(const Corners& from, const Corners& to, const geometry::Se3& to_from_from, const DepthCamera& camera) {
  Links links(from.pixels.size(), kNone);
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (!from.points[i]) continue;
    const Eigen::Vector3d p = to_from_from * *from.points[i];
    if (!(p.z() > 0.1)) continue;
    const Eigen::Vector2d place = project(camera.picture.data(), p);
    const bool is_inside = place.x() > 0 && place.y() > 0 && place.x() < camera.width && place.y() < camera.height;
    if (!is_inside) continue;
    if (const auto found = likestNear(to, place, from.descriptors[i])) links[i] = *found;
  }
  return links;
}

class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

bool seeTheSame(const CalibrationView& a, const CalibrationView& b) {
  constexpr double kWidest = 32 * 3.14159265358979323846 / 180, kFarthest = 0.8;  // [rad] [m]
  const auto b_from_a = inverse(b.world_from_picture) * a.world_from_picture;
  return a.stretch == b.stretch && geometry::logSo3(b_from_a.rotation).norm() < kWidest &&
         b_from_a.translation.norm() < kFarthest;
}

}  // namespace

std::optional<Eigen::Vector2d> depthPixelOf(const CalibrationView& view, const DepthCamera& camera,
                                            const Eigen::Vector2d& pixel) {
  if (camera.is_registered) return pixel;
  const Eigen::Vector3d ray = rayThrough(camera.picture, pixel);
  double depth = 2;  // [m] initial value; the two cameras are close together
  Eigen::Vector2d place = pixel;
  for (int i = 0; i < 3; ++i) {
    place = project(camera.depth.data(), Eigen::Vector3d(camera.depth_from_picture * Eigen::Vector3d(depth * ray)));
    if (!(place.x() >= 0 && place.y() >= 0 && place.x() < view.depth_width - 1 && place.y() < view.depth_height - 1))
      return std::nullopt;
    const auto at = static_cast<std::size_t>(std::lround(place.y())) * static_cast<std::size_t>(view.depth_width) +
                    static_cast<std::size_t>(std::lround(place.x()));
    if (!(view.inverse_depth[at] > 0)) return std::nullopt;
    depth = camera.depth_scale / static_cast<double>(view.inverse_depth[at]);
  }
  return place;
}

std::optional<Eigen::Vector3d> pointAt(const CalibrationView& view, const DepthCamera& camera,
                                       const Eigen::Vector2d& pixel) {
  const auto place = depthPixelOf(view, camera, pixel);
  const auto plane = place ? view.planeAt(*place) : std::nullopt;
  if (!plane) return std::nullopt;
  const double inverse = plane->at(*place) / camera.depth_scale;
  if (!(inverse > 0.05)) return std::nullopt;
  return rayThrough(camera.picture, pixel) / inverse;
}

std::vector<Track> findTracks(const std::vector<CalibrationView>& views, const DepthCamera& camera, std::size_t fewest,
                              std::size_t most) {
  std::vector<Corners> corners;
  std::vector<std::size_t> first{0};  // index of a view's first corner among all
  for (const auto& view : views) {
    corners.push_back(cornersOf(view, camera));
    first.push_back(first.back() + corners.back().pixels.size());
  }
  Groups groups(first.back());
  for (std::size_t a = 0; a < views.size(); ++a) {
    for (std::size_t b = a + 1; b < views.size(); ++b) {
      if (!seeTheSame(views[a], views[b])) continue;
      const auto b_from_a = inverse(views[b].world_from_picture) * views[a].world_from_picture;
      const auto there = linksTo(corners[a], corners[b], b_from_a, camera);
      const auto back = linksTo(corners[b], corners[a], inverse(b_from_a), camera);
      for (std::size_t i = 0; i < there.size(); ++i)
        if (there[i] != kNone && back[there[i]] == i) groups.join(first[a] + i, first[b] + there[i]);
    }
  }
  std::map<std::size_t, Track> tracks;
  // By group: whether one view has two of its corners, which shows a wrong link.
  std::map<std::size_t, bool> is_twice;
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (std::size_t i = 0; i < corners[v].pixels.size(); ++i) {
      const auto group = groups.find(first[v] + i);
      auto& measurements = tracks[group].measurements;
      is_twice[group] = is_twice[group] || (!measurements.empty() && measurements.back().view == v);
      measurements.push_back({v, corners[v].pixels[i], corners[v].sigmas[i]});
    }
  }
  std::vector<Track> all;
  for (auto& [group, track] : tracks) {
    if (track.measurements.size() < fewest || is_twice[group]) continue;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    for (const auto& measurement : track.measurements) {
      const auto point = pointAt(views[measurement.view], camera, measurement.pixel);
      if (!point) continue;
      sum += views[measurement.view].world_from_picture * *point;
      ++count;
    }
    if (count < 2) continue;
    track.point = sum / count;
    all.push_back(std::move(track));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Track& a, const Track& b) { return a.measurements.size() > b.measurements.size(); });
  if (all.size() > most) all.resize(most);
  return all;
}

}  // namespace omnimapper::calibration
