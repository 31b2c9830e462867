#include "omnimapper/graph/Initialization.h"

#include <omnimapper/base/Error.h>

#include <Eigen/SVD>
#include <algorithm>
#include <numeric>

#include "PoseEdges.h"
#include "SparseCholesky.h"

namespace omnimapper::graph {

namespace {

template <int n>
using Matrix = Eigen::Matrix<double, n, n>;
template <int n>
using Vector = Eigen::Matrix<double, n, 1>;

/// Holds one pose of each connected part without a fixed pose, so that the systems have a unique solution and are well
/// conditioned: the first pose with a prior, at the pose of the prior, else the first pose, at its value. Fixed poses
/// are held as well.
std::vector<bool> holdPoses(PoseEdges& edges) {
  std::vector<int> parent(edges.poses.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const PoseEdges::Edge& edge : edges.edges) {
    const int a = root(edge.a), b = root(edge.b);
    parent[std::max(a, b)] = std::min(a, b);
  }
  const int count = static_cast<int>(edges.poses.size());
  std::vector<bool> held(edges.poses.size(), false), tied(edges.poses.size(), false);
  for (int i = 0; i < count; ++i)
    if (edges.poses[i].fixed) held[i] = tied[root(i)] = true;
  for (const PoseEdges::Prior& prior : edges.priors) {
    if (tied[root(prior.pose)]) continue;
    edges.poses[prior.pose].map_from_pose = prior.map_from_pose;
    held[prior.pose] = tied[root(prior.pose)] = true;
  }
  for (int i = 0; i < count; ++i)
    if (root(i) == i && !tied[i]) held[i] = true;
  return held;
}

/// Sum over edges of |A x_a - x_b - c|^2 and over priors of |x_a - c|^2, weighted, with some x held: a least-squares
/// problem with n unknowns for each pose and the same matrix for several right-hand sides.
template <int n>
class LinearSystem {
 public:
  LinearSystem(const PoseEdges& edges, const std::vector<bool>& held) : group_(held.size(), -1) {
    for (std::size_t i = 0; i < held.size(); ++i)
      if (!held[i]) group_[i] = groups_++;
    std::vector<std::vector<int>> below(groups_);
    for (int i = 0; i < groups_; ++i) below[i].push_back(i);
    for (const PoseEdges::Edge& edge : edges.edges) {
      const int a = group_[edge.a], b = group_[edge.b];
      if (a >= 0 && b >= 0) below[std::min(a, b)].push_back(std::max(a, b));
    }
    matrix_.size = n * groups_;
    matrix_.starts.push_back(0);
    for (std::vector<int>& rows : below) {
      std::sort(rows.begin(), rows.end());
      rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
      for (int column = 0; column < n; ++column) {
        for (const int group : rows)
          for (int row = 0; row < n; ++row) matrix_.rows.push_back(n * group + row);
        matrix_.starts.push_back(static_cast<int>(matrix_.rows.size()));
      }
    }
    matrix_.values.assign(matrix_.rows.size(), 0);
    right_ = Eigen::MatrixXd::Zero(matrix_.size, n);
  }

  bool empty() const { return groups_ == 0; }
  bool free(int pose) const { return group_[pose] >= 0; }
  /// The unknowns of a pose in a solution.
  auto rows(const Eigen::MatrixXd& solution, int pose) const { return solution.middleRows<n>(n * group_[pose]); }

  void addToDiagonal(int pose, const Matrix<n>& block) { add(group_[pose], group_[pose], block); }
  /// block: rows of a, columns of b.
  void addBetween(int a, int b, const Matrix<n>& block) {
    if (group_[a] > group_[b])
      add(group_[a], group_[b], block);
    else
      add(group_[b], group_[a], block.transpose());
  }
  template <class Right>
  void addToRight(int pose, const Right& right) {
    right_.block(n * group_[pose], 0, n, right.cols()) += right;
  }
  Eigen::MatrixXd solve(int columns) const {
    SparseCholesky cholesky(matrix_, std::vector<int>(groups_, n));
    if (!cholesky.factorize(matrix_))
      throw base::Error(base::ExitCode::internal, "graph: a Between factor has no information: give it a finite noise");
    return cholesky.solve(right_.leftCols(columns));
  }

 private:
  void add(int row_group, int column_group, const Matrix<n>& block) {
    for (int column = 0; column < n; ++column) {
      const auto begin = matrix_.rows.begin() + matrix_.starts[n * column_group + column];
      const auto end = matrix_.rows.begin() + matrix_.starts[n * column_group + column + 1];
      const auto at = std::lower_bound(begin, end, n * row_group) - matrix_.rows.begin();
      for (int row = 0; row < n; ++row) matrix_.values[at + row] += block(row, column);
    }
  }

  int groups_ = 0;
  std::vector<int> group_;  // of a pose; -1 if it is held
  SymmetricMatrix matrix_;
  Eigen::MatrixXd right_;
};

template <int n>
Matrix<n> rotationOf(const geometry::Se3& pose) {
  if constexpr (n == 2)
    return geometry::project(pose).rotation();
  else
    return pose.rotation.toRotationMatrix();
}

template <int n>
double rotationWeight(const geometry::Matrix6d& information) {
  return n == 2 ? information(5, 5) : information.bottomRightCorner<3, 3>().trace() / 3;
}

/// The rotation nearest to a matrix.
geometry::Se3 nearest(const Matrix<2>& matrix) {
  return geometry::lift({0, 0, std::atan2(matrix(1, 0) - matrix(0, 1), matrix(0, 0) + matrix(1, 1))});
}

geometry::Se3 nearest(const Matrix<3>& matrix) {
  const Eigen::JacobiSVD<Matrix<3>> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix<3> u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
  return {Eigen::Quaterniond(Matrix<3>(u * svd.matrixV().transpose())).normalized(), Eigen::Vector3d::Zero()};
}

/// Minimizes the sum of w |M_a R_ab - M_b|^2 over matrices M. The rows of all M are independent problems with one
/// matrix; row r of M_a is a column of unknowns, its r-th right-hand side.
template <int n>
void solveRotations(const std::vector<bool>& held, PoseEdges& edges) {
  LinearSystem<n> system(edges, held);
  if (system.empty()) return;
  for (const PoseEdges::Edge& edge : edges.edges) {
    const double weight = rotationWeight<n>(edge.information);
    const Matrix<n> a_from_b = rotationOf<n>(edge.a_from_b);
    const bool a_free = system.free(edge.a), b_free = system.free(edge.b);
    if (a_free) system.addToDiagonal(edge.a, weight * Matrix<n>::Identity());
    if (b_free) system.addToDiagonal(edge.b, weight * Matrix<n>::Identity());
    if (a_free && b_free) system.addBetween(edge.a, edge.b, -weight * a_from_b);
    if (a_free && !b_free)
      system.addToRight(edge.a, weight * a_from_b * rotationOf<n>(edges.poses[edge.b].map_from_pose).transpose());
    if (b_free && !a_free)
      system.addToRight(edge.b, weight * (rotationOf<n>(edges.poses[edge.a].map_from_pose) * a_from_b).transpose());
  }
  for (const PoseEdges::Prior& prior : edges.priors) {
    if (!system.free(prior.pose)) continue;
    const double weight = rotationWeight<n>(prior.information);
    system.addToDiagonal(prior.pose, weight * Matrix<n>::Identity());
    system.addToRight(prior.pose, weight * rotationOf<n>(prior.map_from_pose).transpose());
  }
  const Eigen::MatrixXd solution = system.solve(n);
  for (std::size_t i = 0; i < edges.poses.size(); ++i)
    if (system.free(static_cast<int>(i)))
      edges.poses[i].map_from_pose.rotation =
          nearest(Matrix<n>(system.rows(solution, static_cast<int>(i)).transpose())).rotation;
}

/// Minimizes the sum of |t_b - t_a - R_a t_ab|^2, weighted by the information of the translation, rotated into the map.
template <int n>
void solveTranslations(const std::vector<bool>& held, PoseEdges& edges) {
  LinearSystem<n> system(edges, held);
  if (system.empty()) return;
  for (const PoseEdges::Edge& edge : edges.edges) {
    const geometry::Se3& map_from_a = edges.poses[edge.a].map_from_pose;
    const Matrix<n> map_from_b = rotationOf<n>(map_from_a) * rotationOf<n>(edge.a_from_b);
    const Matrix<n> weight = map_from_b * edge.information.template topLeftCorner<n, n>() * map_from_b.transpose();
    const Vector<n> a_to_b = rotationOf<n>(map_from_a) * edge.a_from_b.translation.template head<n>();
    const Vector<n> a = map_from_a.translation.template head<n>();
    const Vector<n> b = edges.poses[edge.b].map_from_pose.translation.template head<n>();
    const bool a_free = system.free(edge.a), b_free = system.free(edge.b);
    if (a_free) system.addToDiagonal(edge.a, weight);
    if (b_free) system.addToDiagonal(edge.b, weight);
    if (a_free && b_free) system.addBetween(edge.a, edge.b, -weight);
    if (a_free) system.addToRight(edge.a, weight * (b_free ? Vector<n>(-a_to_b) : Vector<n>(b - a_to_b)));
    if (b_free) system.addToRight(edge.b, weight * (a_free ? a_to_b : Vector<n>(a + a_to_b)));
  }
  for (const PoseEdges::Prior& prior : edges.priors) {
    if (!system.free(prior.pose)) continue;
    const Matrix<n> turn = rotationOf<n>(prior.map_from_pose);
    const Matrix<n> weight = turn * prior.information.template topLeftCorner<n, n>() * turn.transpose();
    system.addToDiagonal(prior.pose, weight);
    system.addToRight(prior.pose, weight * prior.map_from_pose.translation.template head<n>());
  }
  const Eigen::MatrixXd solution = system.solve(1);
  for (std::size_t i = 0; i < edges.poses.size(); ++i)
    if (system.free(static_cast<int>(i)))
      edges.poses[i].map_from_pose.translation.template head<n>() = system.rows(solution, static_cast<int>(i)).col(0);
}

}  // namespace

void initializeRotationsFirst(Graph& graph) {
  PoseEdges edges = poseEdges(graph);
  const std::vector<bool> held = holdPoses(edges);
  const bool planar =
      std::all_of(edges.poses.begin(), edges.poses.end(), [](const PoseEdges::Pose& pose) { return pose.planar; });
  if (planar) {
    solveRotations<2>(held, edges);
    solveTranslations<2>(held, edges);
  } else {
    solveRotations<3>(held, edges);
    solveTranslations<3>(held, edges);
  }
  storePoses(edges, graph);
}

}  // namespace omnimapper::graph
