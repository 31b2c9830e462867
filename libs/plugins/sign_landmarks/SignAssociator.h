#pragma once

#include <omnimapper/landmarks/LandmarkAssociator.h>
#include <omnimapper/obs/CObservationDoorSigns.h>
#include <omnimapper/plugin/PanTiltOffsets.h>

#include <optional>
#include <string>
#include <vector>

#include "SessionBySigns.h"
#include "SignLandmarksOptions.h"
#include "SignMeasurement.h"
#include "SignTracks.h"
#include "Triangulation.h"

namespace omnimapper::plugins {

/// The signs of one observation, for SignLandmarksPlugin. One that fits no sign of the map waits until enough
/// directions meet.
class SignAssociator : public landmarks::LandmarkAssociator<SignMeasurement> {
 public:
  /// All references must outlive this object.
  SignAssociator(const SignLandmarksOptions& options, const std::string& section, SignTracks& tracks,
                 mapper::PanTiltOffsets& offsets, SessionBySigns& session, const map::KeyFrame& frame,
                 const mapper::View& view)
      : LandmarkAssociator(options, section, frame, view),
        options_(options),
        tracks_(tracks),
        offsets_(offsets),
        session_(session) {}

  /// To be called once.
  mapper::Batch associate(const obs::CObservationDoorSigns& observation);

 protected:
  void describe(const SignMeasurement& measurement, mapper::Decision& decision) const override;
  std::vector<base::LandmarkId> candidates(const SignMeasurement& measurement) override;
  graph::FactorRecord record(const SignMeasurement& measurement, base::VariableId sign) const override;
  std::shared_ptr<const map::LandmarkPayload> learned(const SignMeasurement& measurement,
                                                      const landmarks::LandmarkIds& known) override;
  void addNew(const SignMeasurement& measurement, mapper::Decision decision) override;

 private:
  // If the map is held, the offsets of the camera are not estimated, and their uncertainty counts as noise.
  SignLandmarksOptions measurementOptions() const;
  void findOffsets();
  bool areOffsetsInGraph() const;
  // Returns whether the session was placed reliably. Its signs are then associated from the next key frame on, from the
  // new place.
  bool placeSession(const std::vector<SignMeasurement>& measurements);
  // A session that signs have placed is matched with the signs of the map only, until a factor ties it to the map; a
  // lost session is matched with its own signs only.
  bool mayBeAssociated(const KnownSign& known) const;
  bool isOneOfSeveral(const SignMeasurement& measurement) const;

  const SignLandmarksOptions& options_;
  SignTracks& tracks_;
  mapper::PanTiltOffsets& offsets_;
  SessionBySigns& session_;
  std::string label_;  // of the camera
  std::vector<SignMeasurement> measurements_;
  std::optional<base::VariableId> offset_variable_;
  KnownOffsets known_offsets_;
};

}  // namespace omnimapper::plugins
