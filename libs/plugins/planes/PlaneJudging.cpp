#include "PlaneJudging.h"

#include <omnimapper/geometry/Polygon3.h>
#include <omnimapper/map/Level.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "LevelSurfaces.h"
#include "LineSupport.h"

namespace omnimapper::plugins {

namespace {

/// A landmark with its surface in the map.
struct DrawnLandmark {
  base::LandmarkId id;
  std::shared_ptr<PlanePayload> payload;
  surfaces::Surface surface;
  map::LandmarkShape line;  ///< of the whole line, if only lines measured it
};

std::vector<DrawnLandmark> drawnOf(const PlanePayloads& payloads, const PlaneLandmarkIndex& known,
                                   const mapper::View& view) {
  std::vector<DrawnLandmark> all;
  for (const auto& [id, payload] : payloads) {
    const auto& surface = known.all().at(id);
    DrawnLandmark& drawn = all.emplace_back();
    drawn.id = id;
    drawn.payload = std::make_shared<PlanePayload>(*payload);
    drawn.payload->stretches.reset();
    auto shape = drawn.payload->shape({view.graph.value(surface.variable)}, view.map.key_frames);
    drawn.surface.plane = surface.plane;
    drawn.surface.parts = partsOf(shape);
    if (drawn.surface.parts.empty()) drawn.line = std::move(shape);
  }
  return all;
}

// Median roughness of the surfaces of the map, weighted by area; 0 if unknown.
double usualRoughness(const std::vector<DrawnLandmark>& all) {
  std::vector<std::pair<double, double>> by_roughness;  // and their areas
  double whole = 0;
  for (const DrawnLandmark& drawn : all) {
    if (drawn.payload->roughness.count == 0) continue;
    double area = 0;
    for (const auto& part : drawn.surface.parts) area += geometry::area(geometry::Polygon3{part.outline});
    by_roughness.emplace_back(drawn.payload->roughness.mean(), area);
    whole += area;
  }
  std::sort(by_roughness.begin(), by_roughness.end());
  double below = 0;
  for (const auto& [roughness, area] : by_roughness) {
    below += area;
    if (below >= whole / 2) return roughness;
  }
  return 0;
}

// How often a surface must have been measured as a plane to be drawn; none if it is too rough to be drawn at all.
// `rough`: its roughness relative to the usual one. Planes through the spines of books, the legs of chairs and heaps of
// objects are rougher than walls, and most are upright or tilted. The longer a log is, the more measurements agree by
// chance.
std::optional<std::size_t> measurementsToDraw(const geometry::Plane3& plane, double rough, std::size_t key_frames) {
  constexpr double kLevel = 0.95, kUpright = 0.2;                   // z of the normal
  constexpr double kSmooth = 1.2, kRough = 1.5, kRoughLevel = 2.5;  // relative to the usual roughness
  constexpr std::size_t kLevelOnes = 2, kSmoothOnes = 3, kFewest = 2, kMost = 7, kKeyFramesForOne = 200;
  const double height = std::abs(plane.normal.z());
  const std::size_t by_length = std::min(kMost, kFewest + key_frames / kKeyFramesForOne);
  if (height > kLevel) return rough <= kRoughLevel ? std::optional(kLevelOnes) : std::nullopt;
  if (rough <= kSmooth) return height < kUpright ? std::min(kSmoothOnes, by_length) : by_length;
  return height < kUpright && rough <= kRough ? std::optional(by_length) : std::nullopt;
}

// Judges a landmark that only laser lines measured.
void judgeLine(const LineSupport* support, const map::LandmarkShape& shape, PlanePayload& payload) {
  constexpr std::size_t kFewestLines = 3;
  payload.is_candidate = payload.measurements() < kFewestLines;
  payload.judgement.reset();
  if (!support || shape.lines.empty()) return;
  const auto& [from, to] = shape.lines.front();
  const auto stretches = support->stretchesOf({from.head<2>(), to.head<2>()});
  if (!stretches) return;
  if (!stretches->empty()) {
    payload.stretches = *stretches;
    return;
  }
  payload.is_candidate = true;
  payload.judgement = {surfaces::SurfaceClass::surface, "things in one line, between which beams passed"};
}

}  // namespace

PlanePayloads judged(const PlanePayloads& payloads, const PlaneLandmarkIndex& known, const mapper::View& view) {
  const auto all = drawnOf(payloads, known, view);
  LevelSurfaces level(view.map.layers.find<map::Level>());
  for (const auto& one : all) level.add(one.surface);
  const auto judgements = level.judged(known.emptyPayload().ground, view.map.key_frames);
  const double usual = usualRoughness(all);
  const auto grid = derived::scanGridOf(view, {});
  std::optional<LineSupport> support;
  if (*grid) support.emplace(**grid, view.map.key_frames);
  PlanePayloads results;
  for (std::size_t i = 0; i < all.size(); ++i) {
    PlanePayload& payload = *all[i].payload;
    results[all[i].id] = all[i].payload;
    if (all[i].surface.parts.empty()) {
      judgeLine(support ? &*support : nullptr, all[i].line, payload);
      continue;
    }
    const double rough = usual > 0 ? payload.roughness.mean() / usual : 1;
    const auto needed = measurementsToDraw(level.all()[i].plane, rough, view.map.key_frames.size());
    // Many lines of a laser show that a surface exists, not how far it extends: they count as one measurement.
    constexpr std::size_t kOften = 8;
    const std::size_t planes = payload.planeMeasurements(), lines = payload.measurements() - planes;
    payload.is_candidate = !payload.isAccepted() && (!needed || planes + (lines >= kOften ? 1 : 0) < *needed);
    payload.judgement = judgements[i];
  }
  return results;
}

}  // namespace omnimapper::plugins
