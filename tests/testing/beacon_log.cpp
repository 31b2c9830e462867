// beacon-log LOG TRUTH SEED: writes a simulated drive past beacons and their positions ("x y z" per line) for the
// package test.
#include <omnimapper/testing/SimulatedLog.h>

#include <fstream>
#include <string>

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  omnimapper::testing::SimulatedLogOptions options;
  options.seed = std::stoull(argv[3]);
  options.lasers.clear();
  options.beacons.on = true;
  omnimapper::testing::SimulatedLog(options).writeRawlog(argv[1]);
  std::ofstream truth(argv[2]);
  for (const auto& position : options.beacons.positions) truth << position.transpose() << "\n";
  return truth.flush() ? 0 : 1;
}
