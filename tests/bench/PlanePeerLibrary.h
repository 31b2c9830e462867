/// What bench-planes --peer FILE.so calls in a shared library, so that methods which are built elsewhere run beside
/// ours on the same frames in the same process. Plain C, all names as below, no state between frames that matters.
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct PlanePeerImage {
  const uint16_t* units;  ///< row by row; 0: nothing was measured
  int width, height;
  double metres_per_unit;
  double fx, fy, cx, cy;  ///< [px], without distortion; cx and cy count from the middle of the first pixel
};

int planePeerCount(void);
const char* planePeerName(int peer);
/// Writes for each pixel the number of its plane from 1 on, or 0. What happens here is what is timed.
void planePeerRun(int peer, const struct PlanePeerImage* image, uint16_t* labels);

#ifdef __cplusplus
}
#endif
