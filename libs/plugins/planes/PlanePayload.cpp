#include "PlanePayload.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/graph/ByteIo.h>

#include <algorithm>
#include <cmath>

#include "PlaneExtent.h"
#include "PlaneMeasurement.h"

namespace omnimapper::plugins {

namespace {

// Version 2 added the ground; 3 the boundary; 4 holes; 5 the judgement; 6 whether patches are well seen, and roughness;
// 7 the stretches of a line.
constexpr std::uint64_t kVersion = 7;

// The class of a surface by itself, without what stands beside it.
surfaces::Judgement judgedAlone(const map::LandmarkShape& shape, const geometry::Plane3& plane, double ground) {
  surfaces::Surface surface;
  surface.plane = plane;
  surface.parts = partsOf(shape);
  return surfaces::classify({surface}, ground).front();
}

// The class of a surface that only lines measured: any upright one is a wall for a laser at one height.
surfaces::Judgement judgedByLines(const geometry::Plane3& plane) {
  constexpr double kUpright = 0.2;  // z of the normal
  const bool is_wall = std::abs(plane.normal.z()) < kUpright;
  return {is_wall ? surfaces::SurfaceClass::wall : surfaces::SurfaceClass::surface,
          "measured by lines of a laser only"};
}

void writeWalk(std::ostream& out, const std::vector<Eigen::Vector3d>& walk) {
  graph::writeUint(out, walk.size(), 4);
  for (const auto& point : walk) graph::writeVector(out, point);
}

std::vector<Eigen::Vector3d> readWalk(std::istream& in) {
  std::vector<Eigen::Vector3d> walk;
  for (auto points = graph::readUint(in, 4); points > 0; --points) walk.push_back(graph::readVector<3>(in));
  return walk;
}

// The well seen patches; all patches if those have no area, as of a surface that was only seen from afar.
std::vector<SurfacePatch> wellSeenIfAny(const std::vector<SurfacePatch>& patches) {
  std::vector<SurfacePatch> well_seen;
  bool has_area = false;
  for (const auto& patch : patches) {
    if (!patch.is_well_seen) continue;
    well_seen.push_back(patch);
    has_area = has_area || patch.outlineInBase().size() > 2;
  }
  return has_area ? well_seen : patches;
}

}  // namespace

std::vector<surfaces::FlatPart> partsOf(const map::LandmarkShape& shape) {
  std::vector<surfaces::FlatPart> parts;
  for (std::size_t i = 0; i < shape.surfaces.size(); ++i) {
    parts.push_back({shape.surfaces[i].vertices, {}});
    for (const auto& hole : map::holesIn(shape, i)) parts.back().holes.push_back(hole.vertices);
  }
  return parts;
}

bool PlanePayload::wasSeenAsPlane() const {
  return std::any_of(seen_by.begin(), seen_by.end(), [](const auto& sensor) { return sensor.second.planes > 0; });
}

std::uint32_t PlanePayload::measurements() const {
  std::uint32_t sum = 0;
  for (const auto& [label, seen] : seen_by) sum += seen.planes + seen.lines;
  return sum;
}

std::uint32_t PlanePayload::planeMeasurements() const {
  std::uint32_t sum = 0;
  for (const auto& [label, seen] : seen_by) sum += seen.planes;
  return sum;
}

double PlanePayload::groundIn(const map::KeyFrames& key_frames) const {
  return ground == Ground::map || key_frames.empty() ? 0 : key_frames.front().map_from_base.z();
}

std::shared_ptr<const PlanePayload> PlanePayload::with(base::KeyFrameId frame, const PlaneMeasurement& measurement,
                                                       const News& news) const {
  auto more = std::make_shared<PlanePayload>(*this);
  const bool is_whole = measurement.is_all_well_seen;
  if (news.of_extent || (is_whole && news.of_well_seen))
    more->patches.push_back({frame, measurement.outline_in_base, measurement.holes_in_base, is_whole});
  if (!is_whole && news.of_well_seen)
    for (const auto& part : measurement.well_seen_in_base)
      more->patches.push_back({frame, part.outline, part.holes, true});
  if (measurement.roughness > 0) {
    more->roughness.sum += measurement.roughness;
    ++more->roughness.count;
  }
  SensorCounts& seen = more->seen_by[measurement.sensor_label];
  ++(measurement.is_line ? seen.lines : seen.planes);
  more->resetJudgement();
  more->last_seen_from = frame;
  return more;
}

std::shared_ptr<const PlanePayload> PlanePayload::with(const PlanePayload& other) const {
  auto both = std::make_shared<PlanePayload>(*this);
  both->patches.insert(both->patches.end(), other.patches.begin(), other.patches.end());
  for (const auto& [label, seen] : other.seen_by) {
    both->seen_by[label].planes += seen.planes;
    both->seen_by[label].lines += seen.lines;
  }
  both->roughness.sum += other.roughness.sum;
  both->roughness.count += other.roughness.count;
  if (!both->isAccepted() && other.isAccepted()) {
    both->judgement = other.judgement;
    both->is_candidate = false;
  }
  both->resetJudgement();
  both->last_seen_from = std::max(last_seen_from, other.last_seen_from);
  return both;
}

void PlanePayload::resetJudgement() {
  stretches.reset();
  if (isAccepted()) return;
  judgement.reset();
  is_candidate = false;
}

std::shared_ptr<const map::LandmarkPayload> PlanePayload::seenFrom(const std::set<base::KeyFrameId>& frames) const {
  auto part = std::make_shared<PlanePayload>(*this);
  part->patches.erase(std::remove_if(part->patches.begin(), part->patches.end(),
                                     [&](const SurfacePatch& patch) { return frames.count(patch.frame) == 0; }),
                      part->patches.end());
  return part->patches.empty() ? nullptr : part;
}

geometry::Areas2 PlanePayload::coveredOn(const Eigen::VectorXd& value, const map::KeyFrames& key_frames) const {
  auto entry = std::make_shared<CoveredMemo::Entry>();
  entry->value = value;
  for (const auto& patch : patches)
    entry->frames.push_back(geometry::fromMrpt(key_frames.at(patch.frame).map_from_base));
  const auto isSame = [](const geometry::Se3& a, const geometry::Se3& b) {
    return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
  };
  const auto known = memo_.get();
  if (known && known->value == value && known->frames.size() == entry->frames.size() &&
      std::equal(known->frames.begin(), known->frames.end(), entry->frames.begin(), isSame))
    return known->areas;
  const plane_factors::PlaneAxes axes(plane_factors::PlaneParametrization::of(form).plane(value));
  entry->areas = seenOn(axes, wellSeenIfAny(patches), key_frames);
  memo_.set(entry);
  return entry->areas;
}

map::LandmarkShape PlanePayload::shape(const std::vector<Eigen::VectorXd>& values,
                                       const map::KeyFrames& key_frames) const {
  map::LandmarkShape shape;
  if (values.empty()) return shape;
  const auto plane = plane_factors::PlaneParametrization::of(form).plane(values.front());
  const plane_factors::PlaneAxes axes(plane);
  const auto corners = cornersInMap(patches, key_frames);
  const auto hull = hullOn(axes, corners);
  if (hull.empty()) return shape;
  shape.is_candidate = is_candidate;
  shape.normal = plane.normal;
  // A laser alone measures the length of a wall, not its height.
  if (wasSeenAsPlane() && hull.size() > 2) {
    geometry::Areas2 areas;
    if (boundary == Boundary::seen) areas = coveredOn(values.front(), key_frames);
    if (areas.outlines.empty()) areas = {{hull}, {}};
    double area = 0;
    const auto inSpace = [&](const std::vector<Eigen::Vector2d>& walk) {
      area += geometry::area(walk);
      geometry::Polygon3 polygon;
      for (const auto& corner : walk) polygon.vertices.push_back(axes.inSpace(corner));
      return polygon;
    };
    for (const auto& outline : areas.outlines) shape.surfaces.push_back(inSpace(outline));
    for (const auto& hole : areas.holes) shape.holes.push_back(inSpace(hole));
    shape.properties.push_back({"area", map::Measure{area, "m2"}});
  } else if (hull.size() > 1) {
    const auto [low, high] =
        std::minmax_element(hull.begin(), hull.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
    const Eigen::Vector2d begin = *low, step = *high - *low;
    const double whole = step.norm();
    double length = 0;
    for (const auto& [from, to] : stretches.value_or(Stretches{{0, whole}})) {
      const auto at = [&](double distance) {
        return axes.inSpace(whole > 0 ? Eigen::Vector2d(begin + distance / whole * step) : begin);
      };
      shape.lines.emplace_back(at(from), at(to));
      length += to - from;
    }
    shape.properties.push_back({"length", map::Measure{length, "m"}});
  }
  const auto judged = judgement          ? *judgement
                      : wasSeenAsPlane() ? judgedAlone(shape, plane, groundIn(key_frames))
                                         : judgedByLines(plane);
  shape.label = toString(judged.is);
  shape.reason = judged.reason;
  for (const auto& [label, seen] : seen_by) {
    shape.addSeenBy(label, seen.planes + seen.lines);
  }
  return shape;
}

bool PlanePayload::fits(const std::vector<std::string_view>& kinds) const {
  return kinds == std::vector<std::string_view>{plane_factors::PlaneParametrization::of(form).variable()->kind()};
}

std::vector<base::KeyFrameId> PlanePayload::keyFrames() const {
  std::vector<base::KeyFrameId> frames{last_seen_from};
  for (const auto& patch : patches) frames.push_back(patch.frame);
  return frames;
}

void PlanePayload::write(std::ostream& out) const {
  graph::writeUint(out, kVersion, 1);
  graph::writeUint(out, static_cast<std::uint64_t>(form), 1);
  graph::writeUint(out, static_cast<std::uint64_t>(ground), 1);
  graph::writeUint(out, static_cast<std::uint64_t>(boundary), 1);
  graph::writeUint(out, patches.size(), 4);
  for (const auto& patch : patches) {
    graph::writeId(out, patch.frame);
    writeWalk(out, patch.outlineInBase());
    graph::writeUint(out, patch.holesInBase().size(), 4);
    for (const auto& hole : patch.holesInBase()) writeWalk(out, hole);
    graph::writeUint(out, patch.is_well_seen ? 1 : 0, 1);
  }
  graph::writeId(out, last_seen_from);
  graph::writeUint(out, seen_by.size(), 4);
  for (const auto& [label, seen] : seen_by) {
    graph::writeText(out, label);
    graph::writeUint(out, seen.planes, 4);
    graph::writeUint(out, seen.lines, 4);
  }
  graph::writeText(out, judgement ? toString(judgement->is) : "");
  graph::writeText(out, judgement ? judgement->reason : "");
  graph::writeUint(out, is_candidate ? 1 : 0, 1);
  graph::writeDouble(out, roughness.sum);
  graph::writeUint(out, roughness.count, 4);
  graph::writeUint(out, stretches ? 1 + stretches->size() : 0, 4);
  for (const auto& [from, to] : stretches.value_or(Stretches())) {
    graph::writeDouble(out, from);
    graph::writeDouble(out, to);
  }
}

void PlanePayload::addTo(map::PayloadRegistry& registry) {
  registry.add("plane", [](std::istream& in) {
    const auto version = graph::readUint(in, 1);
    if (version > kVersion) {
      throw base::Error(base::ExitCode::unreadable_input,
                        "a plane of version " + std::to_string(version) + ": this program reads versions up to " +
                            std::to_string(kVersion) + "; take the OmniMapper that wrote the map");
    }
    auto payload = std::make_shared<PlanePayload>();
    payload->form = graph::readUint(in, 1) == 0 ? plane_factors::PlaneParametrization::Kind::plane
                                                : plane_factors::PlaneParametrization::Kind::wall;
    if (version > 1) payload->ground = graph::readUint(in, 1) == 0 ? Ground::start : Ground::map;
    if (version > 2) payload->boundary = graph::readUint(in, 1) == 0 ? Boundary::hull : Boundary::seen;
    for (auto left = graph::readUint(in, 4); left > 0; --left) {
      const auto frame = graph::readId<base::KeyFrameId>(in);
      auto outline = readWalk(in);
      std::vector<std::vector<Eigen::Vector3d>> holes;
      for (auto count = version > 3 ? graph::readUint(in, 4) : 0; count > 0; --count) holes.push_back(readWalk(in));
      const bool is_well_seen = version <= 5 || graph::readUint(in, 1) != 0;
      payload->patches.emplace_back(frame, std::move(outline), std::move(holes), is_well_seen);
    }
    payload->last_seen_from = graph::readId<base::KeyFrameId>(in);
    for (auto left = graph::readUint(in, 4); left > 0; --left) {
      const std::string label = graph::readText(in);
      SensorCounts& seen = payload->seen_by[label];
      seen.planes = static_cast<std::uint32_t>(graph::readUint(in, 4));
      seen.lines = static_cast<std::uint32_t>(graph::readUint(in, 4));
    }
    if (version > 4) {
      const std::string name = graph::readText(in), reason = graph::readText(in);
      if (const auto is = surfaces::surfaceClassNamed(name)) payload->judgement = {*is, reason};
      payload->is_candidate = graph::readUint(in, 1) != 0;
    }
    if (version > 5) {
      payload->roughness.sum = graph::readDouble(in);
      payload->roughness.count = static_cast<std::uint32_t>(graph::readUint(in, 4));
    }
    if (const auto count = version > 6 ? graph::readUint(in, 4) : 0; count > 0) {
      payload->stretches.emplace();
      for (auto left = count - 1; left > 0; --left) {
        const double from = graph::readDouble(in), to = graph::readDouble(in);
        payload->stretches->emplace_back(from, to);
      }
    }
    return payload;
  });
}

}  // namespace omnimapper::plugins
