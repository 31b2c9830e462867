#include <omnimapper/base/Error.h>
#include <omnimapper/matching/MatchCloud.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nanoflann.hpp>
#include <utility>

namespace omnimapper::matching {

namespace {

// A result set of nanoflann: the nearest point within a distance, which keeps the search short from its beginning.
class NearestWithin {
 public:
  using DistanceType = float;
  explicit NearestWithin(float square) : square_(square) {}
  bool full() const { return true; }
  float worstDist() const { return square_; }
  bool addPoint(float square, std::uint32_t index) {
    if (square < square_) {
      square_ = square;
      index_ = index;
    }
    return true;
  }
  std::size_t index() const { return index_; }

 private:
  float square_;
  std::size_t index_ = MatchCloud::kNone;
};

}  // namespace

struct MatchCloud::Tree {
  // The interface through which nanoflann reads points.
  struct Rows {
    const std::vector<Eigen::Vector3f>& points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    float kdtree_get_pt(std::size_t i, std::size_t dimension) const {
      return points[i][static_cast<Eigen::Index>(dimension)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };

  explicit Tree(const std::vector<Eigen::Vector3f>& points)
      : rows{points}, tree(3, rows, nanoflann::KDTreeSingleIndexAdaptorParams(8)) {}
  Rows rows;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Rows>, Rows, 3, std::uint32_t> tree;
};

MatchCloud::MatchCloud(CloudPoints cloud) : cloud_(std::move(cloud)) {
  const std::size_t size = cloud_.points.size();
  const auto fits = [size](std::size_t count) { return count == 0 || count == size; };
  if (!fits(cloud_.normals.size()) || !fits(cloud_.covariances.size()))
    throw base::Error(base::ExitCode::out_of_range, "a cloud needs as many normals and covariances as points, or none");
  const auto is_finite = [](const auto& value) { return value.allFinite(); };
  if (!std::all_of(cloud_.points.begin(), cloud_.points.end(), is_finite) ||
      !std::all_of(cloud_.covariances.begin(), cloud_.covariances.end(), is_finite))
    throw base::Error(base::ExitCode::out_of_range, "a cloud's points and covariances must be finite");
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw base::Error(base::ExitCode::out_of_range, "a cloud has too many points");
}

MatchCloud::~MatchCloud() = default;

const MatchCloud::Tree& MatchCloud::tree() const {
  std::call_once(made_, [this] { tree_ = std::make_unique<Tree>(cloud_.points); });
  return *tree_;
}

std::size_t MatchCloud::nearest(const Eigen::Vector3f& to, float max_distance) const {
  if (size() == 0) return kNone;
  NearestWithin result(max_distance * max_distance);
  tree().tree.findNeighbors(result, to.data(), nanoflann::SearchParams());
  return result.index();
}

}  // namespace omnimapper::matching
