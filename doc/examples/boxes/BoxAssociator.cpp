#include "BoxAssociator.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <Eigen/Cholesky>
#include <utility>

#include "BoxPayload.h"

namespace boxes {

namespace base = omnimapper::base;
namespace graph = omnimapper::graph;
namespace landmarks = omnimapper::landmarks;
namespace map = omnimapper::map;
namespace mapper = omnimapper::mapper;

void KnownBox::refresh(const map::Landmark& landmark, const mapper::View& view) {
  KnownLandmark::refresh(landmark, view);
  class_label = dynamic_cast<const BoxPayload&>(*landmark.payload).classLabel();
}

void BoxAssociator::describe(const Box& box, mapper::Decision& decision) const {
  decision.kind = box.class_label.empty() ? "box" : "box of a " + box.class_label;
  decision.numbers = {{"distance [m]", box.base_from_box.translation.norm()}, {"score", box.score}};
}

std::string BoxAssociator::whyUseless(const Box& box) const {
  if (!box.base_from_box.translation.allFinite() || !(box.size.minCoeff() > 0)) return "it has no place or no size";
  return box.covariance.llt().info() == Eigen::Success ? "" : "its covariance is not positive definite";
}

// All boxes whose class does not contradict; the gate decides which are near enough. For maps with thousands of
// landmarks, a preselection by distance makes this faster.
std::vector<base::LandmarkId> BoxAssociator::candidates(const Box& box) {
  std::vector<base::LandmarkId> alike;
  for (const auto& [id, known] : known_.all())
    if (mayBeOne(box.class_label, known.class_label)) alike.push_back(id);
  return alike;
}

graph::FactorRecord BoxAssociator::record(const Box& box, base::VariableId middle) const {
  graph::FactorRecord record{{frame().pose, middle},
                             std::make_shared<graph::PointFactor3>(box.base_from_box.translation),
                             graph::SquareRootInformation::fromCovariance(box.covariance)};
  record.loss = graph::Loss::huber(3);
  record.tags.note = "box";
  return record;
}

std::shared_ptr<const map::LandmarkPayload> BoxAssociator::learned(const Box& box,
                                                                   const landmarks::LandmarkIds& known) {
  return payloadOf<BoxPayload>(known.landmark).with(box, frame().id);
}

void BoxAssociator::addNew(const Box& box, mapper::Decision decision) {
  const auto map_from_base = omnimapper::geometry::fromMrpt(mapper::poseOf(view().graph, frame().pose));
  addLandmark(
      box, std::move(decision),
      {"box", graph::point3(), map_from_base * box.base_from_box.translation, BoxPayload().with(box, frame().id)});
}

}  // namespace boxes
