#pragma once

#include <omnimapper/obs/CObservationObjects.h>
#include <omnimapper/perception/Extractor.h>
#include <omnimapper/perception/ObjectFinder.h>
#include <omnimapper/perception/PlaneExtractor.h>

#include <atomic>

namespace omnimapper::perception {

struct ObjectPointOptions {
  int max_points = 1000;  ///< largest number of points that are kept of an object

  static const base::OptionTable<ObjectPointOptions>& table();
};

/// Whether planes that an earlier extractor of the chain has found are used instead of finding planes anew.
struct PlaneReuseOptions {
  enum class Reuse { same_options, any_options };
  Reuse reuse = Reuse::same_options;  ///< only planes that were found with the same options, or all

  static const base::OptionTable<PlaneReuseOptions>& table();
};

/// The label of a scan's objects is the scan's label with this suffix.
inline constexpr char kObjectsSuffix[] = ".objects";

/// Extracts the planes of a range camera's depth image and the objects that stand on them, as ObjectFinder finds them
/// (thesis 3.4.6, 3.5.1.2). Since objects refer to their plane by its index, this extractor also returns the planes,
/// which are the same as those of a PlaneExtractor with the same options. In a chain, planes are found only once.
class ObjectExtractor : public Extractor {
 public:
  static constexpr const char* kName = "ObjectExtractor";
  static constexpr const char* kSummary =
      "Finds planes in depth images, as PlaneExtractor does, and the objects that stand on these planes.";

  struct Options {
    PlaneOptions planes;
    OutlineOptions outlines;
    ObjectOptions objects;
    ObjectPointOptions points;
    PlaneReuseOptions reuse;

    PlaneSettings planeSettings() const { return {planes, outlines}; }
  };
  struct Found {
    std::shared_ptr<obs::CObservationPlanes> planes;
    std::shared_ptr<obs::CObservationObjects> objects;
    bool has_surface = false;  ///< whether the scan shows a level surface that objects may stand on
  };

  /// Throws as PlaneSegmenter and ObjectFinder.
  explicit ObjectExtractor(const Options& options)
      : options_(options), segmenter_(options.planes), finder_(options.objects, options.planes) {}
  ObjectExtractor(const PlaneOptions& planes, const OutlineOptions& outlines, const ObjectOptions& objects,
                  const ObjectPointOptions& points, const PlaneReuseOptions& reuse = {})
      : ObjectExtractor(Options{planes, outlines, objects, points, reuse}) {}

  /// The planes and the objects of a scan. Both have the scan's stamp and sensorPose, are in the frame of this pose,
  /// and have the labels "<scan label>.planes" and "<scan label>.objects". The scan's sensorPose determines which
  /// direction is up. An object's points are thinned evenly to at most `max_points`; they have colours if the scan has
  /// a colour for each of them. Throws as PlaneExtractor. Thread-safe; the same scan gives the same bits.
  Found extract(const mrpt::obs::CObservation3DRangeScan& scan) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  /// Without the planes if an earlier extractor has found them: the objects then refer to its planes.
  std::vector<mrpt::obs::CObservation::Ptr> extractUsing(const mrpt::obs::CObservation& raw,
                                                         Blackboard& board) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;
  /// A warning if only objects on level surfaces were asked for, but no scan showed such a surface.
  std::vector<std::string> warnings() const override;

 private:
  Found objectsOn(const PlaneSegmentation& planes, const mrpt::obs::CObservation3DRangeScan& scan,
                  const camera::RgbdView& view) const;

  Options options_;
  PlaneSegmenter segmenter_;
  ObjectFinder finder_;
  mutable std::atomic<std::size_t> scans_{0}, with_surface_{0};  // number of scans given to extract(raw), and of those
                                                                 // with a level surface
};

}  // namespace omnimapper::perception
