// Batch optimization of public pose graphs: our solver, the same problem given directly to Ceres, and MRPT's
// Levenberg-Marquardt, from the same initial values in the same run. Prints a Markdown table.
//
//   OPENBLAS_NUM_THREADS=1 OMP_THREAD_LIMIT=1 bench-graph_batch [runs]
#include <ceres/ceres.h>
#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/graphslam/levmarq.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/graph/G2o.h>
#include <omnimapper/graph/Initialization.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>

namespace {

using namespace omnimapper;
using base::VariableId;
using graph::Graph;

constexpr double kFunctionTolerance = 1e-9;
constexpr int kMaxIterations = 100;

/// Error of a planar edge, for Ceres' automatic derivatives.
struct PlanarEdge {
  template <class T>
  bool operator()(const T* a, const T* b, T* residual) const {
    const T c = cos(a[2]), s = sin(a[2]), dx = b[0] - a[0], dy = b[1] - a[1];
    const T x = c * dx + s * dy - measured.x, y = c * dy - s * dx - measured.y;
    T turn = b[2] - a[2] - measured.yaw;
    turn -= 2 * geometry::kPi * floor((turn + geometry::kPi) / (2 * geometry::kPi));
    const double cm = std::cos(measured.yaw), sm = std::sin(measured.yaw);
    const Eigen::Matrix<T, 3, 1> error(cm * x + sm * y, cm * y - sm * x, turn);
    Eigen::Map<Eigen::Matrix<T, 3, 1>>{residual} = whitening * error;
    return true;
  }
  geometry::Se2 measured;
  Eigen::Matrix3d whitening;
};

/// Error of a spatial edge, with the rotation as twice the vector part of the quaternion, exactly as in g2o.
struct SpatialEdge {
  template <class T>
  bool operator()(const T* a, const T* b, T* residual) const {
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> ta(a), tb(b);
    const Eigen::Map<const Eigen::Quaternion<T>> qa(a + 3), qb(b + 3);
    const Eigen::Quaternion<T> measured_back = measured.rotation.conjugate().cast<T>();
    const Eigen::Quaternion<T> a_from_map = qa.conjugate();
    Eigen::Matrix<T, 6, 1> error;
    error.template head<3>() = measured_back * (a_from_map * (tb - ta) - measured.translation.cast<T>());
    const Eigen::Quaternion<T> turn = measured_back * (a_from_map * qb);
    error.template tail<3>() = T(turn.w() < T(0) ? -2 : 2) * turn.vec();
    Eigen::Map<Eigen::Matrix<T, 6, 1>>{residual} = whitening * error;
    return true;
  }
  geometry::Se3 measured;
  geometry::Matrix6d whitening;
};

/// Wall time and processor time. Other programs on the machine affect only the wall time.
struct Seconds {
  double wall = 0, cpu = 0;
};

Seconds secondsOf(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  work();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          double(std::clock() - cpu_start) / CLOCKS_PER_SEC};
}

double median(std::vector<double> numbers) {
  std::nth_element(numbers.begin(), numbers.begin() + numbers.size() / 2, numbers.end());
  return numbers[numbers.size() / 2];
}

struct Result {
  Seconds seconds;
  int iterations = 0;
  double chi2 = 0;
};

Result solveByUs(Graph graph, graph::SolveOptions::Method method) {
  Result result;
  graph::SolveOptions options;
  options.method = method;
  options.function_tolerance = kFunctionTolerance;
  options.max_iterations = kMaxIterations;
  result.seconds = secondsOf([&] { result.iterations = graph::solve(graph, options).iterations; });
  result.chi2 = graph::g2oChi2(graph);
  return result;
}

void addEdge(const graph::FactorRecord& record, double* a, double* b, ceres::Problem& problem) {
  if (const auto* planar = dynamic_cast<const graph::BetweenSe2*>(record.factor.get()))
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PlanarEdge, 3, 3, 3>(
                                 new PlanarEdge{planar->measured(), Eigen::Matrix3d(record.noise.matrix())}),
                             nullptr, a, b);
  else if (const auto* spatial = dynamic_cast<const graph::BetweenSe3*>(record.factor.get()))
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<SpatialEdge, 6, 7, 7>(
                                 new SpatialEdge{spatial->measured(), geometry::Matrix6d(record.noise.matrix())}),
                             nullptr, a, b);
}

/// `radius`: initial radius of the trust region. Ceres' default, or a large one, with which it begins with Gauss-Newton
/// steps.
Result solveByCeres(Graph graph, double radius) {
  Result result;
  std::map<VariableId, Eigen::VectorXd> values;
  result.seconds = secondsOf([&] {
    ceres::Problem problem;
    for (const auto& [id, record] : graph.variables()) {
      double* const data = values.emplace(id, record.value).first->second.data();
      ceres::Manifold* manifold = nullptr;
      if (record.kind == graph::se3())
        manifold = new ceres::ProductManifold<ceres::EuclideanManifold<3>, ceres::EigenQuaternionManifold>(
            ceres::EuclideanManifold<3>{}, ceres::EigenQuaternionManifold{});
      problem.AddParameterBlock(data, record.kind->ambientSize(), manifold);
      if (record.fixed) problem.SetParameterBlockConstant(data);
    }
    for (const auto& [id, record] : graph.factors())
      addEdge(record, values.at(record.variables[0]).data(), values.at(record.variables[1]).data(), problem);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
    options.function_tolerance = kFunctionTolerance;
    options.max_num_iterations = kMaxIterations;
    options.num_threads = 1;
    options.initial_trust_region_radius = radius;
    options.max_trust_region_radius = 1e32;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    result.iterations = static_cast<int>(summary.iterations.size()) - 1;
  });
  for (const auto& [id, value] : values) graph.setValue(id, value);
  result.chi2 = graph::g2oChi2(graph);
  return result;
}

/// `Network`: MRPT's pose graph with information matrices. `ToMrpt` and `FromMrpt` convert our poses to its poses and
/// back.
template <class Network, class ToMrpt, class FromMrpt>
Result solveByMrpt(Graph graph, const ToMrpt& to_mrpt, const FromMrpt& from_mrpt) {
  Network network;
  for (const auto& [id, record] : graph.variables()) {
    static_cast<typename Network::constraint_t::type_value&>(network.nodes[id.index]) = to_mrpt(record.value);
    if (record.fixed) network.root = id.index;
  }
  for (const auto& [id, record] : graph.factors()) {
    typename Network::constraint_t edge;
    if constexpr (std::is_same_v<typename Network::constraint_t, mrpt::poses::CPosePDFGaussianInf>)
      edge.mean = to_mrpt(graph::toValue(dynamic_cast<const graph::BetweenSe2&>(*record.factor).measured()));
    else
      edge.mean = to_mrpt(graph::toValue(dynamic_cast<const graph::BetweenSe3&>(*record.factor).measured()));
    edge.cov_inv = record.noise.information();
    network.insertEdge(record.variables[0].index, record.variables[1].index, edge);
  }
  Result result;
  mrpt::containers::yaml parameters;
  parameters["max_iterations"] = kMaxIterations;
  mrpt::graphslam::TResultInfoSpaLevMarq info;
  result.seconds = secondsOf([&] { mrpt::graphslam::optimize_graph_spa_levmarq(network, info, nullptr, parameters); });
  result.iterations = static_cast<int>(info.num_iters);
  for (const auto& [id, record] : graph.variables())
    if (!record.fixed) graph.setValue(id, from_mrpt(network.nodes.at(id.index)));
  result.chi2 = graph::g2oChi2(graph);
  return result;
}

Result solveByMrpt(const Graph& graph) {
  using mrpt::poses::CPose2D;
  using mrpt::poses::CPose3D;
  if ((*graph.variables().begin()).second.kind == graph::se2())
    return solveByMrpt<mrpt::graphs::CNetworkOfPoses2DInf>(
        graph, [](const Eigen::VectorXd& value) { return CPose2D(value[0], value[1], value[2]); },
        [](const CPose2D& pose) { return graph::toValue(geometry::fromMrpt(pose)); });
  return solveByMrpt<mrpt::graphs::CNetworkOfPoses3DInf>(
      graph, [](const Eigen::VectorXd& value) { return geometry::toMrpt(graph::se3FromValue(value.data())); },
      [](const CPose3D& pose) { return graph::toValue(geometry::fromMrpt(pose)); });
}

/// The solvers run in turn, so that other load on the machine affects all of them alike.
std::vector<Result> medians(const Graph& graph, const std::vector<std::function<Result(const Graph&)>>& contenders,
                            int runs) {
  std::vector<Result> results(contenders.size());
  std::vector<std::vector<double>> wall(contenders.size()), cpu(contenders.size());
  for (int run = 0; run < runs; ++run)
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      results[i] = contenders[i](graph);
      wall[i].push_back(results[i].seconds.wall);
      cpu[i].push_back(results[i].seconds.cpu);
    }
  for (std::size_t i = 0; i < contenders.size(); ++i) results[i].seconds = {median(wall[i]), median(cpu[i])};
  return results;
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 5;
  std::printf(
      "Wall time (processor time) [s], iterations, chi2 in g2o's convention; median of %d runs.\n\n"
      "| graph | start | its chi2 | dogleg | | | Levenberg-Marquardt | | | Ceres | | | Ceres, radius 1e8 | | | MRPT | "
      "| |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      runs);
  for (const std::string name : {"intel", "manhattan", "city10000", "sphere2500", "parking-garage"}) {
    const auto path = omnimapper::testing::sharedData("posegraphs/" + name + ".g2o");
    if (!path) {
      std::printf("%s: recording not on this machine\n", name.c_str());
      continue;
    }
    for (const std::string start : {"file", "rotations first"}) {
      Graph graph = graph::readG2o(*path).graph;
      std::string made;
      if (start != "file") {
        const Seconds seconds = secondsOf([&] { graph::initializeRotationsFirst(graph); });
        made = " (" + std::to_string(seconds.cpu).substr(0, 5) + " s)";
      }
      std::printf("| %s | %s%s | %.6g |", name.c_str(), start.c_str(), made.c_str(), graph::g2oChi2(graph));
      const std::vector<Result> results =
          medians(graph,
                  {[](const Graph& g) { return solveByUs(g, graph::SolveOptions::Method::dogleg); },
                   [](const Graph& g) { return solveByUs(g, graph::SolveOptions::Method::levenberg_marquardt); },
                   [](const Graph& g) { return solveByCeres(g, 1e4); },
                   [](const Graph& g) { return solveByCeres(g, 1e8); }, [](const Graph& g) { return solveByMrpt(g); }},
                  runs);
      for (const Result& result : results)
        std::printf(" %.3f (%.3f) | %d | %.6g |", result.seconds.wall, result.seconds.cpu, result.iterations,
                    result.chi2);
      std::printf("\n");
      std::fflush(stdout);
    }
  }
}
