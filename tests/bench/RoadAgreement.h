#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/perception/RoadExtractor.h>
#include <omnimapper/perception/RoadSegmenter.h>
#include <omnimapper/sim/Simulation.h>

#include <functional>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <string>
#include <vector>

namespace omnimapper::bench {

/// How many measured pixels of some surfaces are classified as ground.
struct RoadCount {
  double all = 0;
  double sure = 0;      ///< classified as ground by their own normal
  double accepted = 0;  ///< classified as ground in the end
  RoadCount operator+(const RoadCount& other) const {
    return {all + other.all, sure + other.sure, accepted + other.accepted};
  }
};

/// Compares the ground that is found in images of a simulated camera with the truth.
class RoadAgreement {
 public:
  /// `camera`: label of the camera, which must have labels = true. `frames` frames of it are used, spread evenly over
  /// the simulation. `clock` returns the time [s].
  RoadAgreement(const sim::Simulation& simulation, const std::string& camera, int frames,
                const perception::RoadOptions& options, const std::function<double()>& clock)
      : options_(options), clock_(clock) {
    kinds_.push_back(sim::SurfaceKind::clutter);
    for (const auto& ref : sim::numberSurfaces(simulation.world())) {
      const sim::Body& body = simulation.world().bodies[static_cast<std::size_t>(ref.body)];
      const sim::Surface& surface = body.surfaces[static_cast<std::size_t>(ref.surface)];
      if (surface.kind == sim::SurfaceKind::kerb && surface.face) kerb_tops_.insert(kinds_.size());
      kinds_.push_back(surface.kind);
    }
    for (const auto& sensor : simulation.sensors()) {
      if (sensor->label() != camera) continue;
      for (int i = 0; i < frames; ++i) look(sensor->measure(i * sensor->count() / frames));
    }
  }

  /// Counts by kind of surface. Those of kerbs are only of their sides.
  const std::map<sim::SurfaceKind, RoadCount>& ofKinds() const { return of_kind_; }
  /// Time [s] that each frame took.
  const std::vector<double>& times() const { return times_; }
  RoadCount ground() const { return of(sim::SurfaceKind::road) + of(sim::SurfaceKind::floor); }
  /// Sides of kerbs, which face the road: they separate road and pavement.
  RoadCount kerbSides() const { return of(sim::SurfaceKind::kerb); }
  /// Tops of kerbs, which are level and as high as the pavement behind them.
  const RoadCount& kerbTops() const { return of_kerb_tops_; }
  RoadCount others() const {
    RoadCount all;
    for (const auto& [kind, count] : of_kind_) {
      if (kind != sim::SurfaceKind::road && kind != sim::SurfaceKind::floor && kind != sim::SurfaceKind::kerb)
        all = all + count;
    }
    return all;
  }

 private:
  RoadCount of(sim::SurfaceKind kind) const {
    const auto found = of_kind_.find(kind);
    return found == of_kind_.end() ? RoadCount() : found->second;
  }

  void look(const sim::Measurement& measurement) {
    const auto& scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan&>(*measurement.observation);
    const std::string& png = measurement.truth_files.at(0).bytes;
    const cv::Mat names = cv::imdecode(std::vector<char>(png.begin(), png.end()), cv::IMREAD_UNCHANGED);
    const auto& c = scan.cameraParams;
    const camera::DepthImage image(scan.rangeImage.data(), static_cast<double>(scan.rangeUnits),
                                   static_cast<int>(c.ncols), static_cast<int>(c.nrows),
                                   {c.fx(), c.fy(), c.cx(), c.cy()});
    const double begin = clock_();
    const auto found = perception::RoadSegmenter(options_).segment(image, perception::expectedGround(scan, 0));
    times_.push_back(clock_() - begin);
    for (std::size_t i = 0; i < found.sure.size(); ++i) {
      const double depth = scan.rangeImage.data()[i] * static_cast<double>(scan.rangeUnits);
      if (!(depth >= options_.min_depth && depth <= options_.max_depth)) continue;
      const std::size_t surface = names.at<std::uint16_t>(static_cast<int>(i));
      RoadCount& count = kerb_tops_.count(surface) != 0 ? of_kerb_tops_ : of_kind_[kinds_[surface]];
      ++count.all;
      count.sure += found.sure[i];
      count.accepted += found.ground.labels[i] != 0;
    }
  }

  perception::RoadOptions options_;
  std::function<double()> clock_;
  std::vector<sim::SurfaceKind> kinds_;  // by label
  std::set<std::size_t> kerb_tops_;      // labels
  std::map<sim::SurfaceKind, RoadCount> of_kind_;
  RoadCount of_kerb_tops_;
  std::vector<double> times_;
};

}  // namespace omnimapper::bench
