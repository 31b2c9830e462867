#include <omnimapper/base/LibraryBeside.h>
#include <omnimapper/live/SensorDriver.h>

namespace omnimapper::live {

namespace {

using MakeDriver = decltype(&omnimapperMakeDriver);

MakeDriver loaded() {
  static const auto make = reinterpret_cast<MakeDriver>(
      base::functionOfLibrary("libomnimapper-drivers.so", "omnimapperMakeDriver", "the sensors cannot be read",
                              "Install it, or map a log with -r."));
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
