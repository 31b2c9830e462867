// Victoria Park with known association: odometry and points, solved by our solver and by Ceres from the same initial
// values in the same run. Prints a Markdown table. The six and three numbers of noise in the file are upper triangles
// of covariances.
//
// Example: OPENBLAS_NUM_THREADS=1 bench-victoria_park [file] [runs]
#include <ceres/ceres.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>

namespace {

using namespace omnimapper;
using base::VariableId;

constexpr int kSolveEvery = 50;  // poses

Eigen::MatrixXd upperTriangle(std::istream& in, int size) {
  Eigen::MatrixXd matrix(size, size);
  for (int row = 0; row < size; ++row)
    for (int column = row; column < size; ++column) {
      in >> matrix(row, column);
      matrix(column, row) = matrix(row, column);
    }
  return matrix;
}

// Reads the graph. The initial value of each pose is that of the pose before, moved by the odometry. The graph is
// solved every `solve_every` poses; with 0 it is never solved, so that the initial values are odometry alone.
graph::Graph read(const std::string& path, int solve_every) {
  graph::Graph graph;
  std::map<int, VariableId> ids;
  int poses = 0;
  const auto se2Of = [&](int number) { return graph::se2FromValue(graph.value(ids.at(number)).data()); };
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    int from = 0, to = 0;
    double x = 0, y = 0, yaw = 0;
    words >> kind >> from >> to >> x >> y;
    if (kind == "ODOMETRY") {
      words >> yaw;
      if (ids.empty()) ids[from] = graph.addVariable(graph::se2(), Eigen::Vector3d::Zero(), true);
      if (solve_every > 0 && ++poses % solve_every == 0)
        graph::solve(graph, {graph::SolveOptions::Method::levenberg_marquardt, 20, 1e-4, {}});
      if (ids.count(to) == 0)
        ids[to] = graph.addVariable(graph::se2(), graph::toValue(se2Of(from) * geometry::Se2{x, y, yaw}));
      graph.addFactor({{ids.at(from), ids.at(to)},
                       std::make_shared<graph::BetweenSe2>(geometry::Se2{x, y, yaw}),
                       graph::SquareRootInformation::fromCovariance(upperTriangle(words, 3))});
    } else if (kind == "LANDMARK") {
      const auto there = (se2Of(from) * geometry::Se2{x, y, 0}).translation();
      if (ids.count(to) == 0) ids[to] = graph.addVariable(graph::point2(), there);
      graph.addFactor({{ids.at(from), ids.at(to)},
                       std::make_shared<graph::PointFactor2>(Eigen::Vector2d(x, y)),
                       graph::SquareRootInformation::fromCovariance(upperTriangle(words, 2))});
    }
  }
  return graph;
}

struct Edge {
  template <class T>
  bool operator()(const T* a, const T* b, T* residual) const {
    const T c = cos(a[2]), s = sin(a[2]), dx = b[0] - a[0], dy = b[1] - a[1];
    const T x = c * dx + s * dy - measured.x, y = c * dy - s * dx - measured.y;
    T turn = b[2] - a[2] - measured.yaw;
    turn -= 2 * geometry::kPi * floor((turn + geometry::kPi) / (2 * geometry::kPi));
    const double cm = std::cos(measured.yaw), sm = std::sin(measured.yaw);
    Eigen::Map<Eigen::Matrix<T, 3, 1>>{residual} =
        whitening * Eigen::Matrix<T, 3, 1>(cm * x + sm * y, cm * y - sm * x, turn);
    return true;
  }
  geometry::Se2 measured;
  Eigen::Matrix3d whitening;
};

struct Point {
  template <class T>
  bool operator()(const T* a, const T* point, T* residual) const {
    const T c = cos(a[2]), s = sin(a[2]), dx = point[0] - a[0], dy = point[1] - a[1];
    Eigen::Map<Eigen::Matrix<T, 2, 1>>{residual} =
        whitening * Eigen::Matrix<T, 2, 1>(c * dx + s * dy - measured.x(), c * dy - s * dx - measured.y());
    return true;
  }
  Eigen::Vector2d measured;
  Eigen::Matrix2d whitening;
};

int solveByCeres(graph::Graph& graph, double tolerance, int most_iterations) {
  std::map<VariableId, Eigen::VectorXd> values;
  ceres::Problem problem;
  for (const auto& [id, record] : graph.variables()) {
    double* const data = values.emplace(id, record.value).first->second.data();
    problem.AddParameterBlock(data, record.kind->ambientSize());
    if (record.fixed) problem.SetParameterBlockConstant(data);
  }
  for (const auto& [id, record] : graph.factors()) {
    double *const a = values.at(record.variables[0]).data(), *const b = values.at(record.variables[1]).data();
    if (const auto* edge = dynamic_cast<const graph::BetweenSe2*>(record.factor.get()))
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<Edge, 3, 3, 3>(new Edge{edge->measured(), record.noise.matrix()}), nullptr, a,
          b);
    else if (const auto* point = dynamic_cast<const graph::PointFactor2*>(record.factor.get()))
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<Point, 2, 3, 2>(new Point{point->measured(), record.noise.matrix()}), nullptr,
          a, b);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.function_tolerance = tolerance;
  options.parameter_tolerance = options.gradient_tolerance = 1e-16;
  options.max_num_iterations = most_iterations;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  for (const auto& [id, value] : values) graph.setValue(id, value);
  return static_cast<int>(summary.iterations.size()) - 1;
}

}  // namespace

int main(int argc, char** argv) {
  const auto shared = omnimapper::testing::sharedData("posegraphs/victoria_park.txt");
  const std::string path = argc > 1 ? argv[1] : shared.value_or("");
  const int runs = argc > 2 ? std::atoi(argv[2]) : 5;
  const auto seconds = [](const auto& from) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
  };
  const auto driven_from = std::chrono::steady_clock::now();
  const graph::Graph driven = read(path, kSolveEvery);
  const double driven_seconds = seconds(driven_from);
  if (driven.factors().empty()) {
    std::fprintf(stderr, "no edges in '%s'\n", path.c_str());
    return 1;
  }
  struct Contender {
    std::string name;
    std::function<int(graph::Graph&)> solve;
  };
  const auto ours = [](graph::SolveOptions::Method method) {
    return [method](graph::Graph& graph) { return graph::solve(graph, {method, 100, 1e-9, {}}).iterations; };
  };
  const std::vector<Contender> contenders = {
      {"ours, dogleg", ours(graph::SolveOptions::Method::dogleg)},
      {"ours, Levenberg-Marquardt", ours(graph::SolveOptions::Method::levenberg_marquardt)},
      {"Ceres, to 1e-9", [](graph::Graph& graph) { return solveByCeres(graph, 1e-9, 200); }}};
  std::printf(
      "%zu variables, %zu factors; median of %d runs\n\n| start | its chi2 | solver | chi2 | over the optimum | "
      "iterations | time [s] |\n|---|---|---|---|---|---|---|\n",
      driven.variables().size(), driven.factors().size(), runs);
  const std::vector<std::pair<std::string, graph::Graph>> starts = {{"odometry", read(path, 0)},
                                                                    {"solved as driven", driven}};
  for (const auto& [start, begin] : starts) {
    graph::Graph optimum = begin;
    solveByCeres(optimum, 1e-12, 1000);
    std::printf("| %s | %.6g | Ceres, to 1e-12 | %.9g | | | |\n", start.c_str(), begin.chi2(), optimum.chi2());
    for (const auto& [name, solve] : contenders) {
      std::vector<double> times;
      double chi2 = 0;
      int iterations = 0;
      for (int run = 0; run < runs; ++run) {
        graph::Graph graph = begin;
        const auto from = std::chrono::steady_clock::now();
        iterations = solve(graph);
        times.push_back(seconds(from));
        chi2 = graph.chi2();
      }
      std::nth_element(times.begin(), times.begin() + runs / 2, times.end());
      std::printf("| %s | | %s | %.9g | %.1e | %d | %.3f |\n", start.c_str(), name.c_str(), chi2,
                  chi2 / optimum.chi2() - 1, iterations, times[static_cast<std::size_t>(runs / 2)]);
      std::fflush(stdout);
    }
  }
  std::printf("\nsolved every %d poses while it is read: %.2f s in all\n", kSolveEvery, driven_seconds);
}
