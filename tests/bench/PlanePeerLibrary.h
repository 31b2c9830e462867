/// The functions that bench-planes --peer FILE.so calls in a shared library, so that methods which are built elsewhere
/// run on the same frames and in the same process as ours. Plain C with the names below. The result for a frame must
/// not depend on earlier frames.
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct PlanePeerImage {
  const uint16_t* units;  ///< row by row; 0: nothing was measured
  int width, height;
  double metres_per_unit;
  double fx, fy, cx, cy;  ///< [px] of a lens without distortion; cx and cy count from the centre of the first pixel
};

int planePeerCount(void);
const char* planePeerName(int peer);
/// Writes for each pixel the number of its plane, from 1 on, or 0. The whole call is timed.
void planePeerRun(int peer, const struct PlanePeerImage* image, uint16_t* labels);

#ifdef __cplusplus
}
#endif
