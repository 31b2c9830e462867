#pragma once

#include <omnimapper/sim/Simulation.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// signs_seen.csv: a line for each sign that is at least partly visible in a picture of the log, in the log's order.
/// Columns: stamp (Unix time [s]), sensor (its label), measurement (its number), sign (its name in landmarks.json),
/// text (lines separated by '|'), x1 y1 to x4 y4 (corners as in FaceView [pixel]), capitals_px and least_capitals_px,
/// distance_m, incidence_deg, visible, legible (0 or 1) as isLegible() decides.
class SignTruth {
 public:
  explicit SignTruth(const Simulation& simulation);

  /// Whether there are signs, and a sensor that takes pictures.
  bool isWanted() const { return is_wanted_; }
  void add(const Sensor& sensor, int k, const std::vector<SignView>& signs);
  const std::string& table() const { return table_; }
  const SignCounter& counter() const { return counter_; }

 private:
  const World& world_;
  bool is_wanted_;
  SignCounter counter_;
  std::string table_;
};

}  // namespace omnimapper::sim
