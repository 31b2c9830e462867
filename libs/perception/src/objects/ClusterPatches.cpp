#include "ClusterPatches.h"

#include <omnimapper/perception/ConnectedComponents.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace omnimapper::perception::objects {

namespace {

constexpr float kFlat = 0.866F;  // cosine of 30 deg
constexpr int kAside = 3;        // [px] less than the radius of the normals' windows

class Cutter {
 public:
  Cutter(const ClusterComparator& near, const NormalImage& normals)
      : near_(near), normals_(normals), width_(near.points.width) {
    result_.labels.resize(near.points.z.size(), 0);
  }

  ClusterPatches cut(int fewest) {
    collectPixels(fewest);
    joinWithinPatches();
    numberPatches();
    growToPixelsWithoutNormal();
    findContacts();
    return std::move(result_);
  }

 private:
  // A pixel of a cluster, which of its neighbours before it are near, and whether its normal is of one face.
  struct Pixel {
    int at;
    bool near_left, near_above;
    bool has_normal = false;
  };

  std::int32_t& label(int pixel) { return result_.labels[static_cast<std::size_t>(pixel)]; }
  bool hasNormal(int pixel) const { return !std::isnan(normals_.z()[pixel]); }

  // Whether an edge runs so near that the window of the pixel's normal reaches over it: the normals on both sides of
  // the pixel, within the clusters, differ by more than 30 deg.
  bool isNearEdge(int pixel) {
    const int x = pixel % width_, y = pixel / width_;
    const auto differ = [&](int before, int behind) {
      return label(before) != 0 && label(behind) != 0 && !areFlat(before, behind);
    };
    return (x >= kAside && x + kAside < width_ && differ(pixel - kAside, pixel + kAside)) ||
           (y >= kAside && y + kAside < near_.points.height &&
            differ(pixel - kAside * width_, pixel + kAside * width_));
  }
  bool areFlat(int a, int b) const {
    const float *const x = normals_.x(), *const y = normals_.y(), *const z = normals_.z();
    return x[a] * x[b] + y[a] * y[b] + z[a] * z[b] >= kFlat;  // false for NaN
  }

  void collectPixels(int fewest) {
    const Components clusters = connectComponents(width_, near_.points.height, near_);
    std::size_t count = 0;
    const auto counts = [&](const PixelRun& run) {
      return clusters.pixels[static_cast<std::size_t>(run.component)] >= fewest;
    };
    for (const PixelRun& run : clusters.runs) count += counts(run) ? static_cast<std::size_t>(run.end - run.begin) : 0;
    pixels_.reserve(count);
    constexpr std::int32_t kUnknown = -1;
    for (const PixelRun& run : clusters.runs) {
      if (!counts(run)) continue;
      for (int x = run.begin; x < run.end; ++x) {
        const int at = run.row * width_ + x;
        label(at) = kUnknown;
        pixels_.push_back(
            {at, x > run.begin, run.row > 0 && label(at - width_) != 0 && near_.similar(at - width_, at)});
      }
    }
  }

  // Gives each pixel that has a normal a provisional number above 0 and the others 0.
  void joinWithinPatches() {
    sets_.add();  // 0 is no patch
    for (Pixel& pixel : pixels_) pixel.has_normal = hasNormal(pixel.at) && !isNearEdge(pixel.at);
    for (const Pixel& pixel : pixels_) {
      const int at = pixel.at;
      std::int32_t& mine = label(at);
      mine = 0;
      if (!pixel.has_normal) continue;
      if (pixel.near_left && at % width_ % kPatch != 0 && areFlat(at - 1, at))
        mine = label(at - 1);  // 0 if that one counts as without normal
      if (pixel.near_above && at / width_ % kPatch != 0 && areFlat(at - width_, at)) {
        const std::int32_t above = label(at - width_);
        if (mine == 0) {
          mine = above;
        } else if (above != 0 && mine != above) {
          sets_.unite(mine, above);
        }
      }
      if (mine == 0) mine = sets_.add();
    }
  }

  void numberPatches() {
    std::vector<std::int32_t> numbers(static_cast<std::size_t>(sets_.size()), 0);
    const OrganizedPoints& points = near_.points;
    for (const Pixel& pixel : pixels_) {
      std::int32_t& mine = label(pixel.at);
      if (mine == 0) continue;
      std::int32_t& number = numbers[static_cast<std::size_t>(sets_.find(mine))];
      if (number == 0) {
        result_.patches.emplace_back();
        number = static_cast<std::int32_t>(result_.patches.size());
      }
      mine = number;
      Patch& patch = result_.patches[static_cast<std::size_t>(number - 1)];
      const auto i = static_cast<std::size_t>(pixel.at);
      ++patch.pixels;
      patch.middle += Eigen::Vector3f(points.x[i], points.y[i], points.z[i]);
      patch.normal += Eigen::Vector3f(normals_.x()[i], normals_.y()[i], normals_.z()[i]);
    }
    for (Patch& patch : result_.patches) {
      patch.middle /= static_cast<float>(patch.pixels);
      patch.normal.normalize();
    }
  }

  void growToPixelsWithoutNormal() {
    std::vector<int> without;
    for (const Pixel& pixel : pixels_) {
      if (label(pixel.at) == 0) without.push_back(pixel.at);
    }
    std::vector<std::pair<int, std::int32_t>> grown{{0, 0}};
    while (!grown.empty()) {
      grown.clear();
      for (const int at : without) {
        if (const std::int32_t found = labelBeside(at); found != 0) grown.emplace_back(at, found);
      }
      for (const auto& [at, found] : grown) {
        label(at) = found;
        ++result_.patches[static_cast<std::size_t>(found - 1)].pixels;
      }
      without.erase(std::remove_if(without.begin(), without.end(), [&](int at) { return label(at) != 0; }),
                    without.end());
    }
  }

  std::int32_t labelBeside(int at) {
    const int x = at % width_, y = at / width_;
    const auto labelOf = [&](int other) { return near_.similar(at, other) ? label(other) : 0; };
    std::int32_t found = 0;
    if (x > 0) found = labelOf(at - 1);
    if (found == 0 && x + 1 < width_) found = labelOf(at + 1);
    if (found == 0 && y > 0) found = labelOf(at - width_);
    if (found == 0 && y + 1 < near_.points.height) found = labelOf(at + width_);
    return found;
  }

  void findContacts() {
    std::vector<std::uint64_t> pairs;
    pairs.reserve(pixels_.size() / 2);
    const auto add = [&](std::int32_t one, std::int32_t other) {
      if (one == 0 || other == 0 || one == other) return;
      pairs.push_back(static_cast<std::uint64_t>(std::min(one, other)) << 32 |
                      static_cast<std::uint64_t>(std::max(one, other)));
    };
    for (const Pixel& pixel : pixels_) {
      if (pixel.near_left) add(label(pixel.at), label(pixel.at - 1));
      if (pixel.near_above) add(label(pixel.at), label(pixel.at - width_));
    }
    std::sort(pairs.begin(), pairs.end());
    for (std::size_t begin = 0, end = 0; begin < pairs.size(); begin = end) {
      while (end < pairs.size() && pairs[end] == pairs[begin]) ++end;
      result_.contacts.push_back({static_cast<int>(pairs[begin] >> 32) - 1,
                                  static_cast<int>(pairs[begin] & 0xFFFFFFFF) - 1, static_cast<int>(end - begin)});
    }
  }

  const ClusterComparator& near_;
  const NormalImage& normals_;
  int width_;
  std::vector<Pixel> pixels_;  // row by row
  detail::UnionFind sets_;
  ClusterPatches result_;
};

}  // namespace

ClusterPatches cutToPatches(const ClusterComparator& near, const NormalImage& normals, int fewest) {
  return Cutter(near, normals).cut(fewest);
}

}  // namespace omnimapper::perception::objects
