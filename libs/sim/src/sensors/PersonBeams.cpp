#include "PersonBeams.h"

#include <omnimapper/base/Numbers.h>

#include <map>

namespace omnimapper::sim {

namespace {

std::string echoKind(const Echo& echo) {
  if (!echo.is_valid) return "missed";
  if (echo.is_mirrored) return "mirrored";
  return echo.is_mixed ? "mixed" : "clear";
}

}  // namespace

const char* const kPersonBeamsColumns = "stamp,measurement,person,body,speed_m_s,first_beam,beams,echo";

PersonBeams::PersonBeams(const World& world) : world_(world) {
  std::map<std::string, int> person_of_body;
  for (std::size_t i = 0; i < world.people.size(); ++i) {
    for (const std::string& body : world.people[i].bodies) person_of_body[body] = static_cast<int>(i);
  }
  for (const SurfaceRef& surface : numberSurfaces(world)) {
    const auto person = person_of_body.find(world.bodies[surface.body].name);
    owner_of_surface_.push_back(person == person_of_body.end() ? Owner{} : Owner{person->second, surface.body});
  }
}

double PersonBeams::speedOf(int person, double time) const {
  constexpr double kHalf = 0.1;  // [s]
  const Track& torso = jointOf(world_.people[person], "torso").in_map;
  const auto at = [&](double when) { return torso.at(when)->translation; };
  return (at(time + kHalf) - at(time - kHalf)).head<2>().norm() / (2 * kHalf);
}

std::string PersonBeams::rows(const std::vector<Echo>& echoes, int measurement, const std::string& stamp,
                              double time) const {
  const auto ownerOf = [&](std::size_t i) {
    return echoes[i].surface < 0 ? Owner{} : owner_of_surface_[echoes[i].surface];
  };
  std::string text;
  for (std::size_t first = 0, end = 0; first < echoes.size(); first = end) {
    const Owner owner = ownerOf(first);
    const std::string kind = echoKind(echoes[first]);
    for (end = first + 1; end < echoes.size(); ++end) {
      if (ownerOf(end).body != owner.body || echoKind(echoes[end]) != kind) break;
    }
    if (owner.person < 0) continue;
    text += stamp + "," + std::to_string(measurement) + "," + world_.people[owner.person].name + "," +
            world_.bodies[owner.body].name + "," + base::fixed(speedOf(owner.person, time), 2) + "," +
            std::to_string(first) + "," + std::to_string(end - first) + "," + kind + "\n";
  }
  return text;
}

}  // namespace omnimapper::sim
