#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/landmarks/LandmarkAssociator.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "KnownObject.h"
#include "ObjectMeasurement.h"

namespace omnimapper::plugins {

/// Associates the objects of one image with those of the map (thesis 4.4.1.2): where the points of both overlap at the
/// estimated pose, or, if there is no such object, where boxes of like size are near one another. A landmark is the
/// middle of an object's box (a point3); graph::PointFactor3 measures it.
class ObjectAssociator : public landmarks::LandmarkAssociator<ObjectMeasurement> {
 public:
  ObjectAssociator(const ObjectLandmarksOptions& options, const ObjectIndex& known, const map::KeyFrame& frame,
                   const mapper::View& view);

 protected:
  void describe(const ObjectMeasurement& measurement, mapper::Decision& decision) const override;
  std::string whyUseless(const ObjectMeasurement& measurement) const override { return measurement.why_useless; }
  std::vector<base::LandmarkId> candidates(const ObjectMeasurement& measurement) override;
  graph::FactorRecord record(const ObjectMeasurement& measurement, base::VariableId middle) const override;
  std::shared_ptr<const map::LandmarkPayload> learned(const ObjectMeasurement& measurement,
                                                      const landmarks::LandmarkIds& known) override;
  void addNew(const ObjectMeasurement& measurement, mapper::Decision decision) override;

 private:
  ObjectPoints inMap(const ObjectMeasurement& measurement) const;
  // How much of the measurement and of the object lie near one another: the larger share.
  double overlapOf(const ObjectPoints& points, const PointGrid& grid, const KnownObject& object) const;
  // Whether the measurement also shows most of another object: the image did not tell the two apart.
  bool isBlob(const ObjectPoints& points, base::LandmarkId taken_for) const;
  std::shared_ptr<ObjectPayload> firstPayload(const ObjectMeasurement& measurement) const;
  void makeRoom();

  const ObjectLandmarksOptions& options_;
  const ObjectIndex& known_;
  const geometry::Se3 map_from_base_;
  std::map<base::VariableId, const KnownObject*> by_variable_;
  std::set<base::LandmarkId> given_up_;
  std::size_t unconfirmed_ = 0;  // in the map and in this batch
};

}  // namespace omnimapper::plugins
