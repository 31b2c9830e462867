#include "KnownPoint.h"

#include "PointPayload.h"

namespace omnimapper::plugins {

void KnownPoint::refresh(const map::Landmark& landmark, const mapper::View& view) {
  KnownLandmark::refresh(landmark, view);
  number = dynamic_cast<const PointPayload&>(*landmark.payload).number;
}

}  // namespace omnimapper::plugins
