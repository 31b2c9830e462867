#include <omnimapper/base/Numbers.h>
#include <omnimapper/eval/Statistics.h>
#include <omnimapper/eval/ThingQuality.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "ReportLines.h"

namespace omnimapper::eval {

namespace {

using surfaces::Surface;
using surfaces::SurfaceClass;
using surfaces::SurfaceSet;
using surfaces::Thing;

/// The true body on which each drawn surface of the map lies, by index of the surface; of furniture that was not moved.
std::map<std::size_t, std::string> bodiesOf(const MapQuality& quality, const SurfaceSet& truth) {
  std::map<std::size_t, std::string> bodies;
  for (const auto& judged : quality.drawn) {
    if (judged.is_spurious || !judged.true_surface) continue;
    const Surface& surface = truth.surfaces[*judged.true_surface];
    if (surfaces::isOfThing(surface.is) && !surface.is_moved && !surface.body.empty())
      bodies[judged.index] = surface.body;
  }
  return bodies;
}

std::vector<Surface> facesOf(const std::string& body, const SurfaceSet& truth) {
  std::vector<Surface> faces;
  for (const auto& surface : truth.surfaces)
    if (surface.body == body && !cornersOf(surface).empty()) faces.push_back(surface);
  return faces;
}

SurfaceClass classOf(const std::vector<Surface>& faces) {
  std::map<SurfaceClass, double> areas;
  for (const auto& face : faces) areas[face.is] += face.seen ? face.seen->area() : areaOf(face);
  const auto less = [](const auto& a, const auto& b) { return a.second < b.second; };
  return std::max_element(areas.begin(), areas.end(), less)->first;
}

void addWhole(const Thing& thing, const std::vector<Surface>& faces, ThingQuality& quality) {
  constexpr double kDeep = 0.15;  // [m] a thing of which one side was seen is as deep as the noise of its face
  ++quality.whole;
  quality.right_class += thing.is == classOf(faces);
  if (thing.width < kDeep) return;
  const Thing truth = surfaces::thingOf(faces);
  quality.size_errors.push_back(std::abs(thing.length - truth.length));
  quality.size_errors.push_back(std::abs(thing.width - truth.width));
}

}  // namespace

ThingQuality judgeThings(const MapQuality& quality, const SurfaceSet& map, const SurfaceSet& truth) {
  SurfaceSet drawn = map;
  for (auto& surface : drawn.surfaces)
    if (surface.is_candidate) surface.is = SurfaceClass::surface;  // it is of no thing
  ThingQuality result;
  result.things = surfaces::thingsOf(drawn.surfaces);
  const auto bodies = bodiesOf(quality, truth);
  std::map<std::string, std::set<std::size_t>> things_of;
  std::vector<std::set<std::string>> bodies_of(result.things.size());
  for (std::size_t i = 0; i < result.things.size(); ++i) {
    for (const std::size_t face : result.things[i].faces) {
      const auto body = bodies.find(face);
      if (body == bodies.end()) continue;
      things_of[body->second].insert(i);
      bodies_of[i].insert(body->second);
    }
    result.mixed += bodies_of[i].size() > 1;
  }
  result.bodies = things_of.size();
  for (const auto& [body, things] : things_of) {
    result.split += things.size() > 1;
    if (things.size() == 1 && bodies_of[*things.begin()].size() == 1)
      addWhole(result.things[*things.begin()], facesOf(body, truth), result);
  }
  return result;
}

std::string table(const ThingQuality& quality) {
  std::string text = "things of the map: " + std::to_string(quality.things.size()) + "\n";
  text += countLine("true things with a face in the map, as one", quality.whole, quality.bodies);
  text += countLine("  as several things", quality.split, quality.bodies);
  text += countLine("things that have faces of several true ones", quality.mixed, quality.things.size());
  text += countLine("things that are one true thing, right class", quality.right_class, quality.whole);
  text += line("error of their length and width (median)",
               quality.size_errors.empty() ? "-" : base::fixed(statisticsOf(quality.size_errors).median, 2), "m");
  return text;
}

}  // namespace omnimapper::eval
