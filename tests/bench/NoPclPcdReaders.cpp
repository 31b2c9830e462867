#include <cstdio>

#include "PcdReaders.h"

void omnimapper::bench::comparePcdReaders() {
  std::printf("\nPCD readers are not compared, since libpcl-dev was not found when this program was built.\n");
}
