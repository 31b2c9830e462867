#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/landmarks/LandmarkAssociator.h>
#include <omnimapper/landmarks/LandmarkIndex.h>

#include <memory>
#include <string>
#include <vector>

#include "Box.h"

namespace boxes {

/// What the plugin keeps of a box beside map and graph.
struct KnownBox : omnimapper::landmarks::KnownLandmark {
  std::string class_label;  ///< empty: unknown

  void refresh(const omnimapper::map::Landmark& landmark, const omnimapper::mapper::View& view);
};
using BoxIndex = omnimapper::landmarks::LandmarkIndex<KnownBox>;

/// What the boxes of one observation mean; the base class does the rest.
class BoxAssociator : public omnimapper::landmarks::LandmarkAssociator<Box> {
 public:
  BoxAssociator(const BoxOptions& options, const BoxIndex& known, const omnimapper::map::KeyFrame& frame,
                const omnimapper::mapper::View& view)
      : LandmarkAssociator(options, known.owner(), frame, view), known_(known) {}

 protected:
  void describe(const Box& box, omnimapper::mapper::Decision& decision) const override;
  std::string whyUseless(const Box& box) const override;
  std::vector<omnimapper::base::LandmarkId> candidates(const Box& box) override;
  omnimapper::graph::FactorRecord record(const Box& box, omnimapper::base::VariableId middle) const override;
  std::shared_ptr<const omnimapper::map::LandmarkPayload> learned(
      const Box& box, const omnimapper::landmarks::LandmarkIds& known) override;
  void addNew(const Box& box, omnimapper::mapper::Decision decision) override;

 private:
  const BoxIndex& known_;
};

}  // namespace boxes
