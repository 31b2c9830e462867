#include "Targets.h"

/// Entry point of libFuzzer, which runs the target for which this program is built.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const omnimapper::fuzz::Target target = omnimapper::fuzz::targets().at(OMNIMAPPER_FUZZ_TARGET);
  target(data, size);
  return 0;
}
