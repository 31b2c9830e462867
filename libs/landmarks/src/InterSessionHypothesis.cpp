#include <omnimapper/landmarks/InterSessionHypothesis.h>

#include <utility>

namespace omnimapper::landmarks {

bool addInterSessionHypothesis(const mapper::View& view, base::KeyFrameId frame, const mapper::Pairing& pairing,
                               mapper::Decision& decision, mapper::Batch& batch) {
  if (view.areAligned(frame.session, pairing.landmark.session)) return false;
  decision.accepted = false;
  decision.reason = "waits for the consistency test";
  batch.addHypothesis(pairing.record, std::move(decision));
  return true;
}

}  // namespace omnimapper::landmarks
