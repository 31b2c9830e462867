#include "BeaconVariable.h"

namespace beacons {

namespace {

class BeaconVariable : public omnimapper::graph::Variable {
 public:
  std::string_view kind() const override { return "beacon"; }
  int ambientSize() const override { return 3; }
  int tangentSize() const override { return 2; }
  void plus(const double* x, const double* delta, double* y) const override {
    y[0] = x[0] + delta[0];
    y[1] = x[1] + delta[1];
    y[2] = x[2];
  }
  void minus(const double* y, const double* x, double* delta) const override {
    delta[0] = y[0] - x[0];
    delta[1] = y[1] - x[1];
  }
};

}  // namespace

const std::shared_ptr<const omnimapper::graph::Variable>& beaconVariable() {
  static const std::shared_ptr<const omnimapper::graph::Variable> kind = std::make_shared<BeaconVariable>();
  return kind;
}

}  // namespace beacons
