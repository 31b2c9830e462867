#include <cstdio>

#include "PcdReaders.h"

void omnimapper::bench::comparePcdReaders() {
  std::printf("\nPCD readers are not compared: libpcl-dev was not found when this was built.\n");
}
