#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/geometry/Conversions.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <charconv>
#include <ostream>
#include <sstream>
#include <unordered_map>

#include "G2oHyperplanes.h"
#include "omnimapper/graph/Between.h"
#include "omnimapper/graph/G2o.h"
#include "omnimapper/graph/Linearized.h"
#include "omnimapper/graph/PointFactor.h"
#include "omnimapper/graph/Prior.h"
#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph {

namespace {

/// Writes lines into a text, and numbers with the fewest digits that keep every bit.
class Lines {
 public:
  Lines& start(const std::string& tag) {
    text_ << (text_.tellp() > 0 ? "\n" : "") << tag;
    return *this;
  }
  Lines& add(std::int64_t number) {
    text_ << ' ' << number;
    return *this;
  }
  Lines& add(double value) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    text_ << ' ' << std::string_view(digits, static_cast<std::size_t>(end - digits));
    return *this;
  }
  template <class Vector>
  Lines& addAll(const Vector& values) {
    for (const double value : values) add(value);
    return *this;
  }
  Lines& addUpperTriangle(const Eigen::MatrixXd& matrix) {
    for (int row = 0; row < matrix.rows(); ++row)
      for (int column = row; column < matrix.cols(); ++column) add(matrix(row, column));
    return *this;
  }
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

class G2oWriter {
 public:
  explicit G2oWriter(const Graph& graph) : graph_(graph) {
    for (const auto& [id, record] : graph.variables()) is_planar_ = is_planar_ || record.kind->kind() == se2()->kind();
    for (const auto& [id, record] : graph.variables())
      if (!(addVertex(id, record) || addHyperplane(id, record))) ++left_out_[std::string(record.kind->kind())];
    if (has_planes_) addSensorOfPlanes();
    for (const auto& [id, record] : graph.factors())
      if (!addFactor(record)) ++left_out_[std::string(record.factor->kind())];
  }

  void write(std::ostream& out) const {
    for (const auto& [kind, count] : left_out_) out << "# left out: " << count << " of kind " << kind << '\n';
    for (const auto& [kind, count] : linearized_) out << "# to first order: " << count << " of kind " << kind << '\n';
    if (losses_ > 0) out << "# losses left out: " << losses_ << '\n';
    if (needs_offset_) out << "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n";
    out << lines_.text() << '\n';
  }

 private:
  bool addVertex(base::VariableId id, const VariableRecord& record) {
    static const std::map<std::string_view, std::string> tags = {
        {"se2", "VERTEX_SE2"}, {"se3", "VERTEX_SE3:QUAT"}, {"point2", "VERTEX_XY"}, {"point3", "VERTEX_TRACKXYZ"}};
    const auto tag = tags.find(record.kind->kind());
    if (tag == tags.end()) return false;
    startVertex(tag->second, id).addAll(record.value);
    if (record.fixed) lines_.start("FIX").add(numbers_.at(id));
    return true;
  }

  // For poses on the floor, an upright plane is the line where it meets the floor.
  bool addHyperplane(base::VariableId id, const VariableRecord& record) {
    const Eigen::VectorXd hyperplane = record.kind->hyperplane(record.value.data());
    if (hyperplane.size() == 0) return false;
    if (is_planar_) {
      if (!g2o::hasLine(hyperplane)) return false;
      constexpr std::int64_t kNoEnd = -1;
      startVertex("VERTEX_LINE2D", id).addAll(g2o::lineOf(hyperplane)).add(kNoEnd).add(kNoEnd);
    } else {
      if (hyperplane.size() != 4) return false;
      startVertex("VERTEX_PLANE", id).addAll(hyperplane).addAll(kGrey);
      has_planes_ = true;
    }
    if (record.fixed) lines_.start("FIX").add(numbers_.at(id));
    return true;
  }

  // Edges to planes have a third vertex, the sensor's pose in the base: ours is the base itself.
  void addSensorOfPlanes() {
    sensor_ = static_cast<std::int64_t>(numbers_.size());
    lines_.start("VERTEX_SE3:QUAT").add(sensor_).addAll(toValue(geometry::Se3{}));
    lines_.start("FIX").add(sensor_);
  }

  Lines& startVertex(const std::string& tag, base::VariableId id) {
    const auto number = static_cast<std::int64_t>(numbers_.size());
    numbers_[id] = number;
    return lines_.start(tag).add(number);
  }

  /// Returns false if the format cannot hold the factor.
  bool addFactor(const FactorRecord& record) {
    if (record.weight == 0) return false;
    for (const auto id : record.variables)
      if (numbers_.count(id) == 0) return false;
    if (!(addHyperplaneEdge(record) || addEdgeOfKinds(record))) return false;
    if (record.loss.kind() != Loss::Kind::none) ++losses_;
    return true;
  }

  // Factors of lifted poses are left out, because their kind is not that of the factor's slot.
  bool addEdgeOfKinds(const FactorRecord& record) {
    for (std::size_t i = 0; i < record.variables.size(); ++i)
      if (graph_.variable(record.variables[i]).kind->kind() != record.factor->variableKinds()[i]) return false;
    return addPoseEdge(record) || addPointEdge(record) || addPrior(record);
  }

  bool addPoseEdge(const FactorRecord& record) {
    if (const auto* planar = dynamic_cast<const BetweenSe2*>(record.factor.get())) {
      startEdge("EDGE_SE2", record).addAll(toValue(planar->measured()));
      lines_.addUpperTriangle(information(record));
    } else if (const auto* spatial = dynamic_cast<const BetweenSe3*>(record.factor.get())) {
      startEdge("EDGE_SE3:QUAT", record).addAll(toValue(spatial->measured()));
      lines_.addUpperTriangle(geometry::informationToG2o(information(record)));
    } else {
      return false;
    }
    return true;
  }

  bool addPointEdge(const FactorRecord& record) {
    if (const auto* planar = dynamic_cast<const PointFactor2*>(record.factor.get())) {
      startEdge("EDGE_SE2_XY", record).addAll(planar->measured());
    } else if (const auto* spatial = dynamic_cast<const PointFactor3*>(record.factor.get())) {
      startEdge("EDGE_SE3_TRACKXYZ", record).add(std::int64_t{0}).addAll(spatial->measured());
      needs_offset_ = true;
    } else {
      return addLinearizedPoint(record);
    }
    lines_.addUpperTriangle(information(record));
    return true;
  }

  // Any measurement of a point from a pose, such as range and bearing, is to first order a measurement of its
  // coordinates in the base, with the same residual and the same information at the current values.
  bool addLinearizedPoint(const FactorRecord& record) {
    const auto kinds = record.factor->variableKinds();
    if (kinds.size() != 2) return false;
    const bool is_planar = kinds[0] == se2()->kind() && kinds[1] == point2()->kind();
    const bool is_spatial = kinds[0] == se3()->kind() && kinds[1] == point3()->kind();
    if (!is_planar && !is_spatial) return false;
    const Linearized factor(graph_, record);
    const Eigen::VectorXd &pose = graph_.value(record.variables[0]), &point = graph_.value(record.variables[1]);
    Eigen::MatrixXd map_from_base;
    Eigen::VectorXd in_base;
    if (is_planar) {
      map_from_base = Eigen::Rotation2Dd(pose[2]).toRotationMatrix();
      in_base = map_from_base.transpose() * (point - pose.head<2>());
    } else {
      const auto pose3 = se3FromValue(pose.data());
      map_from_base = pose3.rotation.toRotationMatrix();
      in_base = map_from_base.transpose() * (point - pose3.translation);
    }
    const Eigen::MatrixXd by_place = factor.jacobians[1] * map_from_base;
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(by_place);
    if (solver.rank() < in_base.size()) return false;
    const Eigen::VectorXd measured = in_base - solver.solve(factor.residual);
    startEdge(is_planar ? "EDGE_SE2_XY" : "EDGE_SE3_TRACKXYZ", record);
    if (is_spatial) lines_.add(std::int64_t{0});
    needs_offset_ = needs_offset_ || is_spatial;
    lines_.addAll(measured).addUpperTriangle(record.weight * by_place.transpose() * by_place);
    ++linearized_[std::string(record.factor->kind())];
    return true;
  }

  bool addHyperplaneEdge(const FactorRecord& record) {
    if (record.variables.size() != 2) return false;
    const auto& pose = *graph_.variable(record.variables[0]).kind;
    const base::VariableId other = record.variables[1];
    if (graph_.variable(other).kind->hyperplane(graph_.value(other).data()).size() == 0) return false;
    if (pose.kind() == se2()->kind()) {
      const auto edge = g2o::lineEdge(graph_, record);
      startEdge("EDGE_SE2_LINE2D", record).addAll(edge.measured).addUpperTriangle(edge.information);
    } else if (pose.kind() == se3()->kind() && has_planes_) {
      const auto edge = g2o::planeEdge(graph_, record);
      startEdge("EDGE_SE3_PLANE_CALIB", record).add(sensor_).addAll(edge.measured).addAll(kGrey);
      lines_.addUpperTriangle(edge.information);
    } else {
      return false;
    }
    ++linearized_[std::string(record.factor->kind())];
    return true;
  }

  bool addPrior(const FactorRecord& record) {
    if (const auto* planar = dynamic_cast<const PriorSe2*>(record.factor.get())) {
      startEdge("EDGE_PRIOR_SE2", record).addAll(toValue(planar->measured()));
      lines_.addUpperTriangle(information(record));
    } else if (const auto* spatial = dynamic_cast<const PriorSe3*>(record.factor.get())) {
      startEdge("EDGE_SE3_PRIOR", record).add(std::int64_t{0}).addAll(toValue(spatial->measured()));
      lines_.addUpperTriangle(geometry::informationToG2o(information(record)));
      needs_offset_ = true;
    } else {
      return false;
    }
    return true;
  }

  Lines& startEdge(const std::string& tag, const FactorRecord& record) {
    lines_.start(tag);
    for (const base::VariableId id : record.variables) lines_.add(numbers_.at(id));
    return lines_;
  }

  static Eigen::MatrixXd information(const FactorRecord& record) { return record.weight * record.noise.information(); }

  const Graph& graph_;
  std::unordered_map<base::VariableId, std::int64_t> numbers_;
  std::map<std::string, int> left_out_, linearized_;
  const Eigen::Vector3d kGrey{0.5, 0.5, 0.5};  // g2o's planes have a color
  std::int64_t sensor_ = -1;
  bool is_planar_ = false, has_planes_ = false;
  int losses_ = 0;
  bool needs_offset_ = false;
  Lines lines_;
};

}  // namespace

void writeG2o(const Graph& graph, std::ostream& out) {
  G2oWriter(graph).write(out);
}

void writeG2o(const Graph& graph, const std::string& path) {
  base::writeFile(path, [&](std::ostream& out) { writeG2o(graph, out); });
}

}  // namespace omnimapper::graph
