#include "omnimapper/graph/OptimizeRun.h"

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <optional>
#include <ostream>
#include <vector>

#include "GaugeCheck.h"
#include "omnimapper/graph/G2o.h"
#include "omnimapper/graph/Initialization.h"
#include "omnimapper/graph/Marginals.h"
#include "omnimapper/graph/PoseByPose.h"
#include "omnimapper/graph/Solver.h"

namespace omnimapper::graph {

namespace {

using base::brief;

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A step of the incremental solver.
struct Step {
  std::size_t factors = 0;
  IncrementalSummary summary;
  double seconds = 0;
};

class OptimizeRun {
 public:
  explicit OptimizeRun(const OptimizeRequest& request) : request_(request), content_(readG2o(request.input)) {
    if (content_.graph.factors().size() == 0)
      throw base::Error(base::ExitCode::nothing_to_map,
                        request.input + ": has no edges, so that there is nothing to do");
    refuseUnconstrained();
    base::makeWritableFolder(request.output);
    if (request.closure_loss.kind() != Loss::Kind::none) setLosses();
    chi2_before_ = g2oChi2(content_.graph);
  }

  OptimizeResult run() {
    const auto start = std::chrono::steady_clock::now();
    request_.method == OptimizeRequest::Method::batch ? solveBatch() : solveIncrementally();
    seconds_ = secondsSince(start);
    writeG2o(content_.graph, request_.output + "/optimized.g2o");
    base::writeFile(request_.output + "/poses.csv", [&](std::ostream& out) { writePoses(out); });
    if (!steps_.empty()) base::writeFile(request_.output + "/steps.csv", [&](std::ostream& out) { writeSteps(out); });
    return {text(), converged_};
  }

 private:
  void refuseUnconstrained() const {
    const auto variable = unconstrainedVariable(content_.graph);
    if (!variable) return;
    for (const auto& [number, id] : content_.ids)
      if (id == *variable)
        throw base::Error(base::ExitCode::unreadable_input,
                          request_.input + ": no edges lead from a fixed vertex or a prior to vertex " +
                              std::to_string(number) + ": add an edge, or a row FIX " + std::to_string(number));
  }
  /// The file's numbers tell which poses follow each other.
  void setLosses() {
    std::map<base::VariableId, std::int64_t> number_of;
    for (const auto& one : content_.ids) number_of[one.second] = one.first;
    std::vector<base::FactorId> closures;
    for (const auto& [id, record] : content_.graph.factors())
      if (record.variables.size() == 2 && record.factor->kind().substr(0, 7) == "between" &&
          std::abs(number_of[record.variables[0]] - number_of[record.variables[1]]) != 1)
        closures.push_back(id);
    for (const auto id : closures) content_.graph.setLoss(id, request_.closure_loss);
  }

  bool goesOn(double share) {
    if (!is_stopped_ && request_.progress) is_stopped_ = !request_.progress(share);
    return !is_stopped_;
  }

  /// Rotations first, where its cost is lower than that of the file's poses.
  void chooseStart() {
    Graph rotations = content_.graph;
    try {
      initializeRotationsFirst(rotations);
    } catch (const base::Error&) {
      return;  // the edges do not determine the rotations
    }
    is_bad_start_ = !(content_.graph.cost() <= rotations.cost());
    if (is_bad_start_) content_.graph = std::move(rotations);
  }

  void solveBatch() {
    if (request_.start == OptimizeRequest::Start::best) chooseStart();
    if (request_.start == OptimizeRequest::Start::odometry) initializeByChaining(content_.graph);
    if (request_.start == OptimizeRequest::Start::rotations) initializeRotationsFirst(content_.graph);
    SolveOptions options;
    int iterations = 0;
    options.stop = [&] { return !goesOn(static_cast<double>(++iterations) / options.max_iterations); };
    const SolveSummary summary = solve(content_.graph, options);
    converged_ = summary.converged;
    how_ = base::counted(static_cast<std::uint64_t>(summary.iterations), "iteration") + ", ended because " +
           summary.reason;
    if (is_bad_start_) how_ += "; rotations were solved for first, because the file's poses are a worse start";
  }

  void solveIncrementally() {
    IncrementalSolver solver;
    PoseByPose growth(content_.graph);
    double slowest = 0;
    for (std::size_t i = 0; i < growth.steps() && goesOn(static_cast<double>(i) / static_cast<double>(growth.steps()));
         ++i) {
      const auto added = growth.grow(solver);
      if (added.empty()) continue;
      const auto start = std::chrono::steady_clock::now();
      const IncrementalSummary summary = solver.update(growth.graph(), {added, {}, {}, {}});
      steps_.push_back({added.size(), summary, secondsSince(start)});
      slowest = std::max(slowest, steps_.back().seconds);
    }
    if (is_stopped_) throw base::Error(base::ExitCode::interrupted, "interrupted: nothing was written");
    converged_ = solver.converge();
    how_ = base::counted(steps_.size(), "step") + ", the slowest " + brief(1000 * slowest, 3) + " ms";
    for (const auto& one : content_.ids) {
      const base::VariableId here = one.second;
      if (content_.graph.factorsOf(here).empty()) continue;
      const base::VariableId there = growth.idOf(here);
      if (solver.contains(there)) content_.graph.setValue(here, solver.value(there));
    }
  }

  void writePoses(std::ostream& out) const {
    std::optional<Marginals> marginals;
    if (request_.has_sigmas) marginals.emplace(content_.graph);
    out << "vertex,kind,values" << (marginals ? ",sigmas" : "") << "\n";
    for (const auto& [number, id] : content_.ids) {
      const VariableRecord& record = content_.graph.variable(id);
      out << number << "," << record.kind->kind() << "," << joined(record.value);
      if (marginals && marginals->contains(id))
        out << "," << joined(marginals->covariance(id).diagonal().cwiseMax(0).cwiseSqrt());
      out << "\n";
    }
  }
  static std::string joined(const Eigen::VectorXd& numbers) {
    std::string text;
    for (const double number : numbers) text += (text.empty() ? "" : " ") + brief(number, 12);
    return text;
  }

  void writeSteps(std::ostream& out) const {
    out << "step,factors,variables_eliminated,variables_relinearized,milliseconds\n";
    for (std::size_t i = 0; i < steps_.size(); ++i)
      out << i << "," << steps_[i].factors << "," << steps_[i].summary.eliminated << ","
          << steps_[i].summary.relinearized << "," << brief(1000 * steps_[i].seconds, 6) << "\n";
  }

  std::string text() const {
    std::string text = request_.input + ": " + std::to_string(content_.graph.variables().size()) + " vertices, " +
                       base::counted(content_.graph.factors().size(), "edge");
    if (content_.repaired > 0)
      text += "; information matrices that are not positive definite: " + std::to_string(content_.repaired) +
              ", the first on line " + std::to_string(content_.first_repaired) +
              "; each is taken as the nearest that is";
    if (content_.left_out > 0) text += "; " + base::counted(content_.left_out, "row") + " of lines or planes left out";
    text += "\nchi2 " + brief(chi2_before_, 6) + " -> " + brief(g2oChi2(content_.graph), 6) + " in " +
            brief(seconds_, 3) + " s: " + how_ + "\n";
    if (!converged_) text += "It did not converge: the values are the best so far, and no minimum.\n";
    return text + "in " + request_.output + ": optimized.g2o, poses.csv" + (steps_.empty() ? "" : ", steps.csv") + "\n";
  }

  const OptimizeRequest& request_;
  G2oContent content_;
  double chi2_before_ = 0, seconds_ = 0;
  bool converged_ = false, is_stopped_ = false, is_bad_start_ = false;
  std::string how_;
  std::vector<Step> steps_;
};

}  // namespace

OptimizeResult runOptimize(const OptimizeRequest& request) {
  return OptimizeRun(request).run();
}

}  // namespace omnimapper::graph
