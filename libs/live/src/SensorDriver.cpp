#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/live/SensorDriver.h>

namespace omnimapper::live {

namespace {

using MakeDriver = decltype(&omnimapperMakeDriver);

MakeDriver loaded() {
  static const auto make = reinterpret_cast<MakeDriver>(
      base::functionOfFeature("omnimapperMakeDriver", "the sensors cannot be read", "map a log with -r"));
  return make;
}

}  // namespace

void loadDrivers() {
  loaded();
}

std::unique_ptr<SensorDriver> makeDriver(const SensorSection& section) {
  return std::unique_ptr<SensorDriver>(loaded()(section));
}

}  // namespace omnimapper::live
