#include "BoxPlugin.h"

#include <omnimapper/base/AtLoad.h>
#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/landmarks/Fit.h>
#include <omnimapper/landmarks/LandmarkMerging.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "BoxPayload.h"

namespace landmarks = omnimapper::landmarks;
namespace map = omnimapper::map;
namespace mapper = omnimapper::mapper;

namespace boxes {

using omnimapper::obs::CObservationObjects;

bool BoxPlugin::wants(const mrpt::obs::CObservation& observation) const {
  return dynamic_cast<const CObservationObjects*>(&observation) != nullptr;
}

mapper::Batch BoxPlugin::associate(const map::KeyFrame& frame, const mapper::Observed& observed,
                                   const mapper::View& view) {
  const auto& observation = dynamic_cast<const CObservationObjects&>(observed.observation);
  return BoxAssociator(options_, known(), frame, view).take(boxesOf(observation, options_));
}

// Two boxes are one object if their classes agree, their middles agree within the covariance of the map, and each
// middle is within the other box.
mapper::Batch BoxPlugin::merge(const mapper::View& view) {
  const double limit = omnimapper::graph::chiSquareQuantile(options_.confidence, 3);
  landmarks::LandmarkMerging<BoxPayload> merging(view, known().owner());
  const auto& all = known().all();
  for (auto a = all.begin(); a != all.end(); ++a) {
    for (auto b = std::next(a); b != all.end(); ++b) {
      if (!merging.mayMerge(a->first, b->first)) continue;
      const auto &of_a = merging.payloadOf(a->first), &of_b = merging.payloadOf(b->first);
      const auto gap = view.graph.value(b->second.variable) - view.graph.value(a->second.variable);
      if (!mayBeOne(of_a.classLabel(), of_b.classLabel())) continue;
      if (gap.norm() > 0.5 * std::min(of_a.size.minCoeff(), of_b.size.minCoeff())) continue;
      const auto fit = landmarks::fitOfGap(a->second.variable, b->second.variable, view);
      if (fit && fit->chi2 <= limit) merging.merge(a->first, b->first, {fit->chi2, limit, ""});
    }
  }
  return merging.take();
}

void BoxPlugin::registerKinds(mapper::Kinds& kinds) {
  BoxPayload::addTo(kinds.payloads);
}

const omnimapper::base::AtLoad kRegister([] { mapper::FactoryOf<BoxPlugin, BoxOptions>::registerClass(); });

}  // namespace boxes
