#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/geometry/Conversions.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <istream>
#include <optional>
#include <set>

#include "G2oTokens.h"
#include "omnimapper/graph/Between.h"
#include "omnimapper/graph/G2o.h"
#include "omnimapper/graph/Initialization.h"
#include "omnimapper/graph/PointFactor.h"
#include "omnimapper/graph/Prior.h"
#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph {

namespace {

using Kind = std::shared_ptr<const Variable>;

/// The nearest matrix, by the sum of squared differences, whose smallest eigenvalue is a billionth of its largest. None
/// if the largest is not positive: then the matrix says nothing.
std::optional<Eigen::MatrixXd> nearestPositiveDefinite(const Eigen::MatrixXd& symmetric) {
  constexpr double kLeast = 1e-9;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(symmetric);
  const Eigen::VectorXd& values = eigen.eigenvalues();
  const double largest = values[values.size() - 1];
  if (!(largest > 0)) return std::nullopt;
  const Eigen::MatrixXd& vectors = eigen.eigenvectors();
  const Eigen::MatrixXd repaired = vectors * values.cwiseMax(kLeast * largest).asDiagonal() * vectors.transpose();
  return Eigen::MatrixXd(0.5 * (repaired + repaired.transpose()));
}

bool isPositiveDefinite(const Eigen::MatrixXd& symmetric) {
  const Eigen::LLT<Eigen::MatrixXd> cholesky(symmetric);
  return cholesky.info() == Eigen::Success && cholesky.matrixLLT().diagonal().minCoeff() > 0;
}

class G2oReader {
 public:
  void read(G2oTokens& line) {
    const std::string tag(line.word());
    if (tag.empty() || tag.front() == '#') return;
    if (!(readVertex(tag, line) || readPoseEdge(tag, line) || readPointEdge(tag, line) || readPrior(tag, line) ||
          readOther(tag, line) || skipHyperplane(tag, line)))
      line.fail("there is no reader for \"" + tag + "\"");
    if (!line.atEnd()) line.fail("there is more on the line than " + tag + " takes");
  }

  G2oContent finish() {
    for (const std::int64_t sensor : sensors_of_planes_) {
      const bool is_bound = std::any_of(edges_.begin(), edges_.end(), [sensor](const Edge& edge) {
        return std::find(edge.vertices.begin(), edge.vertices.end(), sensor) != edge.vertices.end();
      });
      if (is_bound) continue;
      vertices_.erase(sensor);
      fixed_.erase(sensor);
    }
    for (const std::int64_t number : hyperplanes_) fixed_.erase(number);
    for (const auto& [number, line] : fixed_)
      if (vertices_.count(number) == 0) line.fail("there is no vertex " + std::to_string(number) + " to fix");
    G2oContent content;
    for (const auto& [number, vertex] : vertices_)
      content.ids[number] = content.graph.addVariable(vertex.kind, vertex.value, fixed_.count(number) > 0);
    for (Edge& edge : edges_) {
      for (const std::int64_t number : edge.vertices) edge.record.variables.push_back(content.ids.at(number));
      content.graph.addFactor(std::move(edge.record));
    }
    content.left_out = left_out_;
    content.repaired = repaired_;
    content.first_repaired = first_repaired_;
    fillValues(content);
    if (fixed_.empty() && !has_prior_) fixFirstPose(content);
    return content;
  }

 private:
  struct Vertex {
    Kind kind;
    Eigen::VectorXd value;
    bool has_value;
  };
  struct Edge {
    std::vector<std::int64_t> vertices;
    FactorRecord record;
  };

  bool readVertex(const std::string& tag, G2oTokens& line) {
    if (tag == "VERTEX_SE2") {
      const std::int64_t number = line.id();
      addVertex(number, se2(), toValue(readSe2(line)), line);
    } else if (tag == "VERTEX_SE3:QUAT") {
      const std::int64_t number = line.id();
      addVertex(number, se3(), toValue(readSe3(line)), line);
    } else if (tag == "VERTEX_XY") {
      const std::int64_t number = line.id();
      addVertex(number, point2(), line.numbers<2>(), line);
    } else if (tag == "VERTEX_TRACKXYZ") {
      const std::int64_t number = line.id();
      addVertex(number, point3(), line.numbers<3>(), line);
    } else {
      return false;
    }
    return true;
  }

  bool readPoseEdge(const std::string& tag, G2oTokens& line) {
    if (tag == "EDGE_SE2") {
      const auto numbers = readNumbers({se2(), se2()}, line);
      const geometry::Se2 a_from_b = readSe2(line);
      addEdge(numbers, std::make_shared<BetweenSe2>(a_from_b), line.symmetric<3>(), line);
    } else if (tag == "EDGE_SE3:QUAT") {
      const auto numbers = readNumbers({se3(), se3()}, line);
      const geometry::Se3 a_from_b = readSe3(line);
      addEdge(numbers, std::make_shared<BetweenSe3>(a_from_b), geometry::informationFromG2o(line.symmetric<6>()), line);
    } else {
      return false;
    }
    return true;
  }

  bool readPointEdge(const std::string& tag, G2oTokens& line) {
    if (tag == "EDGE_SE2_XY") {
      const auto numbers = readNumbers({se2(), point2()}, line);
      const Eigen::Vector2d point_in_base = line.numbers<2>();
      addEdge(numbers, std::make_shared<PointFactor2>(point_in_base), line.symmetric<2>(), line);
    } else if (tag == "EDGE_SE3_TRACKXYZ") {
      const auto numbers = readNumbers({se3(), point3()}, line);
      const geometry::Se3 base_from_sensor = offset(line);
      const Eigen::Vector3d point_in_sensor = line.numbers<3>();
      const Eigen::Matrix3d turn = base_from_sensor.rotation.toRotationMatrix();
      addEdge(numbers, std::make_shared<PointFactor3>(base_from_sensor * point_in_sensor),
              turn * line.symmetric<3>() * turn.transpose(), line);
    } else {
      return false;
    }
    return true;
  }

  bool readPrior(const std::string& tag, G2oTokens& line) {
    if (tag == "EDGE_PRIOR_SE2") {
      const auto numbers = readNumbers({se2()}, line);
      const geometry::Se2 map_from_a = readSe2(line);
      addEdge(numbers, std::make_shared<PriorSe2>(map_from_a), line.symmetric<3>(), line);
    } else if (tag == "EDGE_SE3_PRIOR") {
      const auto numbers = readNumbers({se3()}, line);
      if (geometry::minus(offset(line), geometry::Se3{}).norm() > 1e-12)
        line.fail("a prior on a frame with an offset from its vertex is not supported");
      const geometry::Se3 map_from_a = readSe3(line);
      addEdge(numbers, std::make_shared<PriorSe3>(map_from_a), geometry::informationFromG2o(line.symmetric<6>()), line);
    } else {
      return false;
    }
    has_prior_ = true;
    return true;
  }

  bool readOther(const std::string& tag, G2oTokens& line) {
    if (tag == "PARAMS_SE3OFFSET") {
      const std::int64_t number = line.id();
      offsets_[number] = readSe3(line);
    } else if (tag == "FIX") {
      while (!line.atEnd()) fixed_.emplace(line.id(), line);
    } else {
      return false;
    }
    return true;
  }

  // Lines and planes are kinds of landmarks, which this library does not know.
  bool skipHyperplane(const std::string& tag, G2oTokens& line) {
    if (tag == "VERTEX_LINE2D" || tag == "VERTEX_PLANE") {
      hyperplanes_.insert(line.id());
    } else if (tag == "EDGE_SE3_PLANE_CALIB") {
      line.id();
      line.id();
      sensors_of_planes_.insert(line.id());
    } else if (tag != "EDGE_SE2_LINE2D") {
      return false;
    }
    while (!line.atEnd()) line.number();
    ++left_out_;
    return true;
  }

  static geometry::Se2 readSe2(G2oTokens& line) {
    const Eigen::Vector3d v = line.numbers<3>();
    return {v[0], v[1], geometry::wrapToPi(v[2])};
  }

  static geometry::Se3 readSe3(G2oTokens& line) {
    const Eigen::Matrix<double, 7, 1> v = line.numbers<7>();
    const Eigen::Quaterniond rotation(v[6], v[3], v[4], v[5]);
    if (std::abs(rotation.norm() - 1) > 0.01) line.fail("the quaternion is not of length 1");
    return {rotation.normalized(), v.head<3>()};
  }

  const geometry::Se3& offset(G2oTokens& line) const {
    const std::int64_t number = line.id();
    const auto found = offsets_.find(number);
    if (found == offsets_.end()) line.fail("there is no PARAMS_SE3OFFSET " + std::to_string(number) + " before it");
    return found->second;
  }

  void addVertex(std::int64_t number, const Kind& kind, const Eigen::VectorXd& value, const G2oTokens& line) {
    Vertex& vertex = vertices_[number];
    if (vertex.has_value) line.fail("vertex " + std::to_string(number) + " is defined twice");
    if (vertex.kind && vertex.kind != kind)
      line.fail("an earlier edge uses vertex " + std::to_string(number) + " as a " + std::string(vertex.kind->kind()));
    vertex = {kind, value, true};
  }

  /// The vertices of an edge; those that were not named before are added without a value.
  std::vector<std::int64_t> readNumbers(const std::vector<Kind>& kinds, G2oTokens& line) {
    std::vector<std::int64_t> numbers;
    for (const Kind& kind : kinds) {
      numbers.push_back(line.id());
      Vertex& vertex = vertices_[numbers.back()];
      if (!vertex.kind) vertex = {kind, identity(*kind), false};
      if (vertex.kind != kind)
        line.fail("vertex " + std::to_string(numbers.back()) + " is a " + std::string(vertex.kind->kind()) +
                  ", the edge takes a " + std::string(kind->kind()));
    }
    if (numbers.size() == 2 && numbers[0] == numbers[1]) line.fail("the edge connects a vertex with itself");
    return numbers;
  }

  static Eigen::VectorXd identity(const Variable& kind) {
    Eigen::VectorXd value = Eigen::VectorXd::Zero(kind.ambientSize());
    if (kind.kind() == "se3") value[6] = 1;
    return value;
  }

  void addEdge(const std::vector<std::int64_t>& numbers, std::shared_ptr<const Factor> factor,
               const Eigen::MatrixXd& information, const G2oTokens& line) {
    std::optional<Eigen::MatrixXd> repaired;
    if (information.allFinite() && !isPositiveDefinite(information)) repaired = nearestPositiveDefinite(information);
    if (repaired && repaired_++ == 0) first_repaired_ = line.lineNumber();
    try {
      edges_.push_back(
          {numbers, {{}, std::move(factor), SquareRootInformation::fromInformation(repaired.value_or(information))}});
    } catch (const base::Error& error) {
      line.fail(error.what());
    }
  }

  void fixFirstPose(G2oContent& content) const {
    for (const auto& [number, id] : content.ids) {
      const std::string_view kind = content.graph.variable(id).kind->kind();
      if (kind != "se2" && kind != "se3") continue;
      content.graph.setFixed(id, true);
      return;
    }
  }

  /// Vertices that only edges name get their values from those that have values.
  void fillValues(G2oContent& content) const {
    const Graph read = content.graph;
    bool all_known = true;
    for (const auto& [number, vertex] : vertices_) {
      all_known &= vertex.has_value;
      if (vertex.has_value) content.graph.setFixed(content.ids.at(number), true);
    }
    if (!all_known) initializeByChaining(content.graph);
    for (const auto& [id, record] : read.variables()) content.graph.setFixed(id, record.fixed);
  }

  std::map<std::int64_t, Vertex> vertices_;
  std::vector<Edge> edges_;
  std::map<std::int64_t, geometry::Se3> offsets_;
  std::map<std::int64_t, G2oTokens> fixed_;  // with the lines that fix them
  std::set<std::int64_t> hyperplanes_, sensors_of_planes_;
  std::size_t left_out_ = 0, repaired_ = 0;
  int first_repaired_ = 0;
  bool has_prior_ = false;
};

}  // namespace

G2oContent readG2o(std::istream& in, const std::string& name) {
  G2oReader reader;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    G2oTokens tokens(line, name, number);
    reader.read(tokens);
  }
  if (in.bad())
    throw base::Error(base::ExitCode::damaged_input, name + ": the file cannot be read to its end: check the disk");
  return reader.finish();
}

G2oContent readG2o(const std::string& path) {
  auto in = base::openInput(path, "g2o file");
  return readG2o(in, path);
}

}  // namespace omnimapper::graph
