#include "TileLabelling.h"

#include "InverseDepth.h"
#include "Lanes.h"

namespace omnimapper::perception::planes {

namespace {

typedef std::uint16_t Labels __attribute__((vector_size(kLanes * sizeof(std::uint16_t))));

OMNIMAPPER_KERNEL_BODY void storeLabels(const LaneMask& labels, std::uint16_t* to) {
  const Labels narrow = __builtin_convertvector(labels, Labels);
  std::memcpy(to, &narrow, sizeof(narrow));
}

// State of the decision for eight pixels.
struct Decision {
  LaneMask candidate{};  // index + 1; 0 = none fits
  LaneMask label{};
  Lanes plane{}, residual{};
};

OMNIMAPPER_KERNEL_BODY void consider(int k, const Lanes& q, const Lanes& plane, const TileCandidates& c,
                                     float tolerance, Decision& decided) {
  const Lanes difference = q - plane;
  const Lanes residual = difference < 0.F ? -difference : difference;
  const LaneMask fits = (residual <= tolerance) & (q > 0.F);
  LaneMask wins = fits & (decided.candidate == 0);
  for (int j = 0; j < k; ++j) {
    const LaneMask contested = fits & (decided.candidate == j + 1);
    const float nearer = c.nearer_wins[j][k];
    const LaneMask better = nearer == 0.F ? residual < decided.residual : (plane - decided.plane) * nearer > 0.F;
    wins |= contested & better;
  }
  decided.candidate = wins ? LaneMask{} + (k + 1) : decided.candidate;
  decided.label = wins ? LaneMask{} + c.label[k] : decided.label;
  decided.plane = wins ? plane : decided.plane;
  decided.residual = wins ? residual : decided.residual;
}

// `count` is a compile-time constant for one and two candidates; most cells have no more.
OMNIMAPPER_KERNEL_BODY void labelPixelsOf(int count, const float* values, int stride, const TileCandidates& c,
                                          float tolerance, std::uint16_t* labels) {
  Lanes columns;
  load(columns, kLaneColumns);
  for (int y = 0; y < kCell; ++y, values += stride, labels += stride) {
    for (int x = 0; x < kCell; x += kLanes) {
      Lanes q;
      load(q, values + x);
      Decision decided;
      for (int k = 0; k < count; ++k) {
        const float start = c.c[k] + c.b[k] * static_cast<float>(y) + c.a[k] * static_cast<float>(x);
        consider(k, q, columns * c.a[k] + start, c, tolerance, decided);
      }
      storeLabels(decided.label, labels + x);
    }
  }
}

OMNIMAPPER_KERNEL_BODY void labelTileBody(const float* values, int stride, const TileCandidates& c, float tolerance,
                                          std::uint16_t* labels) {
  if (c.count == 1) {
    labelPixelsOf(1, values, stride, c, tolerance, labels);
  } else if (c.count == 2) {
    labelPixelsOf(2, values, stride, c, tolerance, labels);
  } else {
    labelPixelsOf(c.count, values, stride, c, tolerance, labels);
  }
}

#ifdef OMNIMAPPER_KERNEL_AVX2
OMNIMAPPER_KERNEL_AVX2 void labelTileAvx2(const float* values, int stride, const TileCandidates& candidates,
                                          float tolerance, std::uint16_t* labels) {
  labelTileBody(values, stride, candidates, tolerance, labels);
}
#endif

}  // namespace

void labelTile(const float* values, int stride, const TileCandidates& candidates, float tolerance,
               std::uint16_t* labels) {
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (hasAvx2()) return labelTileAvx2(values, stride, candidates, tolerance, labels);
#endif
  labelTileBody(values, stride, candidates, tolerance, labels);
}

}  // namespace omnimapper::perception::planes
