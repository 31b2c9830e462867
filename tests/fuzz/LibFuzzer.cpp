#include "Targets.h"

/// libFuzzer's way in to the target that this program is built for.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const omnimapper::fuzz::Target target = omnimapper::fuzz::targets().at(OMNIMAPPER_FUZZ_TARGET);
  target(data, size);
  return 0;
}
