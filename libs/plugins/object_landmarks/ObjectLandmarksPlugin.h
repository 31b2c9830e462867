#pragma once

#include <omnimapper/landmarks/LandmarkPlugin.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/WatchesObservations.h>

#include <memory>

#include "KnownObject.h"
#include "ObjectCarriers.h"
#include "ObjectLandmarksOptions.h"
#include "ObjectLook.h"

namespace omnimapper::plugins {

/// Objects on tables, shelves and floors as landmarks (thesis 4.4.1), which an extractor finds in the depth images of
/// key frames (CObservationObjects). Each has a model of the points of several views, a picture, and the surface that
/// carries it; those that turn out to be one are merged.
///
/// In every depth image, also between key frames, the objects of the map are looked for: each is seen, hidden behind
/// something nearer, or absent, when the image shows what is behind it. An object that is absent from several images is
/// retired: it is gone.
class ObjectLandmarksPlugin : public landmarks::LandmarkPlugin<ObjectIndex>, public mapper::WatchesObservations {
 public:
  static constexpr const char* kName = "ObjectLandmarksPlugin";
  static constexpr const char* kSummary =
      "Objects on tables, shelves and floors as landmarks with models, and whether they are still there.";
  static void registerKinds(mapper::Kinds& kinds);

  ObjectLandmarksPlugin(const ObjectLandmarksOptions& options, const mapper::PluginContext& context);

  bool wants(const mrpt::obs::CObservation& observation) const override;
  std::unique_ptr<const mapper::Prepared> prepareUsing(const mrpt::obs::CObservation& observation,
                                                       const perception::Blackboard& board) const override;
  bool watches(const mrpt::obs::CObservation& observation) const override;
  mapper::WatchResult watch(const mapper::Watched& watched, const mapper::View& view) override;

 protected:
  mapper::Batch associate(const map::KeyFrame& frame, const mapper::Observed& observed,
                          const mapper::View& view) override;
  mapper::Batch merge(const mapper::View& view) override;
  mapper::Batch finish(const mapper::View& view) override;

 private:
  Sight lookAt(const KnownObject& object, const LookingCamera& camera, const mapper::WatchedPose& pose,
               const mapper::View& view) const;
  // Ends the life of an object that is gone; null if the evidence does not say so.
  void retireIfGone(KnownObject& object, base::Stamp stamp, const mapper::WatchedPose& pose,
                    mapper::Batch& batch) const;
  // Whether it stands on nothing and the options want only what stands.
  bool isAfloat(const ObjectPayload& payload, const std::optional<map::Box>& box, const ObjectCarriers& carriers) const;
  // Says of each object that is gone on which surface it stood, of those which the map has now.
  void placeGone(const ObjectCarriers& carriers, const mapper::View& view, mapper::Batch& batch) const;
  // Adds what was seen between key frames to the payloads that `batch` does not change.
  void describeLooks(mapper::Batch& batch);

  ObjectLandmarksOptions options_;
  bool map_is_held_;
  base::Stamp looked_at_{};  // the last image in which objects were looked for
};

}  // namespace omnimapper::plugins
