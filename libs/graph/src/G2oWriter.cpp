#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/geometry/Conversions.h>

#include <charconv>
#include <ostream>
#include <sstream>
#include <unordered_map>

#include "omnimapper/graph/Between.h"
#include "omnimapper/graph/G2o.h"
#include "omnimapper/graph/PointFactor.h"
#include "omnimapper/graph/Prior.h"
#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph {

namespace {

/// One line after another into a text; numbers in the fewest digits that keep every bit.
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
    for (const auto& [id, record] : graph.variables()) addVertex(id, record);
    for (const auto& [id, record] : graph.factors())
      if (!addFactor(record)) ++left_out_[std::string(record.factor->kind())];
  }

  void write(std::ostream& out) const {
    for (const auto& [kind, count] : left_out_) out << "# left out: " << count << " of kind " << kind << '\n';
    if (losses_ > 0) out << "# losses left out: " << losses_ << '\n';
    if (needs_offset_) out << "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n";
    out << lines_.text() << '\n';
  }

 private:
  void addVertex(base::VariableId id, const VariableRecord& record) {
    static const std::map<std::string_view, std::string> tags = {
        {"se2", "VERTEX_SE2"}, {"se3", "VERTEX_SE3:QUAT"}, {"point2", "VERTEX_XY"}, {"point3", "VERTEX_TRACKXYZ"}};
    const auto tag = tags.find(record.kind->kind());
    if (tag == tags.end()) {
      ++left_out_[std::string(record.kind->kind())];
      return;
    }
    const auto number = static_cast<std::int64_t>(numbers_.size());
    numbers_[id] = number;
    lines_.start(tag->second).add(number).addAll(record.value);
    if (record.fixed) lines_.start("FIX").add(number);
  }

  /// False if the format cannot hold it.
  bool addFactor(const FactorRecord& record) {
    if (record.weight == 0) return false;
    for (std::size_t i = 0; i < record.variables.size(); ++i)
      if (numbers_.count(record.variables[i]) == 0 ||
          graph_.variable(record.variables[i]).kind->kind() != record.factor->variableKinds()[i])
        return false;
    if (!(addPoseEdge(record) || addPointEdge(record) || addPrior(record))) return false;
    if (record.loss.kind() != Loss::Kind::none) ++losses_;
    return true;
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
      return false;
    }
    lines_.addUpperTriangle(information(record));
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
  std::map<std::string, int> left_out_;
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
