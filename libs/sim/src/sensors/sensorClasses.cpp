#include <omnimapper/sim/Sensor.h>

namespace omnimapper::sim {

const std::vector<SensorClass>& sensorClasses() {
  static const std::vector<SensorClass> classes{};
  return classes;
}

}  // namespace omnimapper::sim
