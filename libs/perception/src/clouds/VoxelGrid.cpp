#include "VoxelGrid.h"

#include <cmath>
#include <cstdint>

namespace omnimapper::perception::clouds {

namespace {

constexpr float kReach = 1 << 20;  // largest distance from the origin, in cubes
constexpr std::uint64_t kNoKey = ~std::uint64_t{0};

/// Numbers keys in the order in which they first occur, by a hash table with open addressing.
class Numbering {
 public:
  Numbering() : slots_(std::size_t{1} << bits_, kNoVoxel) {}

  int numberOf(std::uint64_t key) {
    if (key == last_key_) return last_;
    if (2 * keys_.size() >= slots_.size()) grow();
    std::size_t slot = slotOf(key);
    while (slots_[slot] != kNoVoxel && keys_[static_cast<std::size_t>(slots_[slot])] != key) slot = next(slot);
    if (slots_[slot] == kNoVoxel) {
      slots_[slot] = static_cast<int>(keys_.size());
      keys_.push_back(key);
    }
    last_key_ = key;
    return last_ = slots_[slot];
  }

  int count() const { return static_cast<int>(keys_.size()); }

 private:
  std::size_t slotOf(std::uint64_t key) const { return (key * 0x9E3779B97F4A7C15ULL) >> (64 - bits_); }
  std::size_t next(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }

  void grow() {
    ++bits_;
    slots_.assign(std::size_t{1} << bits_, kNoVoxel);
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      std::size_t slot = slotOf(keys_[i]);
      while (slots_[slot] != kNoVoxel) slot = next(slot);
      slots_[slot] = static_cast<int>(i);
    }
  }

  int bits_ = 15;
  std::vector<int> slots_;
  std::vector<std::uint64_t> keys_;
  std::uint64_t last_key_ = kNoKey;
  int last_ = kNoVoxel;
};

std::uint64_t keyOf(const Eigen::Vector3f& point, float per_metre) {
  std::uint64_t key = 0;
  for (int i = 0; i < 3; ++i) {
    const float cube = std::floor(point[i] * per_metre);
    if (!(cube >= -kReach && cube < kReach)) return kNoKey;  // NaN, too
    key = key << 21 | static_cast<std::uint64_t>(static_cast<std::int64_t>(cube) + (1 << 20));
  }
  return key;
}

}  // namespace

Voxels averaged(const std::vector<Eigen::Vector3f>& points, double voxel, double min_range, double max_range) {
  Voxels voxels;
  voxels.of_point.reserve(points.size());
  const auto least = static_cast<float>(min_range * min_range), most = static_cast<float>(max_range * max_range);
  const auto per_metre = static_cast<float>(voxel > 0 ? 1 / voxel : 0);
  Numbering numbering;
  std::vector<int>& sizes = voxels.sizes;
  for (const Eigen::Vector3f& point : points) {
    const float range = point.squaredNorm();
    const std::uint64_t key = range >= least && range <= most ? keyOf(point, per_metre) : kNoKey;
    const bool is_new = voxel <= 0;
    const int number = key == kNoKey ? kNoVoxel : is_new ? static_cast<int>(sizes.size()) : numbering.numberOf(key);
    voxels.of_point.push_back(number);
    if (number == kNoVoxel) continue;
    const auto i = static_cast<std::size_t>(number);
    if (i == sizes.size()) {
      sizes.push_back(1);
      voxels.means.push_back(point);
    } else {
      ++sizes[i];
      voxels.means[i] += point;
    }
  }
  for (std::size_t i = 0; i < sizes.size(); ++i) voxels.means[i] /= static_cast<float>(sizes[i]);
  return voxels;
}

std::vector<int> cubesOf(const std::vector<Eigen::Vector3f>& points, double cell, int& count) {
  std::vector<int> cubes;
  cubes.reserve(points.size());
  Numbering numbering;
  for (const Eigen::Vector3f& point : points) {
    const std::uint64_t key = keyOf(point, static_cast<float>(1 / cell));
    cubes.push_back(key == kNoKey ? kNoVoxel : numbering.numberOf(key));
  }
  count = numbering.count();
  return cubes;
}

}  // namespace omnimapper::perception::clouds
