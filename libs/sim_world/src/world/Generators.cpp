#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/Generators.h>

#include "PlaceGenerators.h"
#include "PlanChecks.h"

namespace omnimapper::sim {

namespace {

struct Generator {
  const char* name;
  void (*make)(Arrangement& place, const WorldOptions& options);
  bool has_plan_seed = false;
};
constexpr Generator kGenerators[] = {{"none", [](Arrangement&, const WorldOptions&) {}},
                                     {"home", makeHome, true},
                                     {"office", makeOffice, true},
                                     {"laboratory", makeLaboratory, true},
                                     {"two_offices", makeTwoOffices},
                                     {"loop", makeLoop},
                                     {"corridor_loop", makeCorridorLoop},
                                     {"box", makeBox},
                                     {"road", makeRoad}};

std::vector<std::string> variedNames() {
  std::vector<std::string> names;
  for (const Generator& generator : kGenerators) {
    if (generator.has_plan_seed) names.emplace_back(generator.name);
  }
  return names;
}

}  // namespace

const std::vector<std::string>& generatorNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const Generator& generator : kGenerators) result.emplace_back(generator.name);
    return result;
  }();
  return names;
}

WorldPlan generate(const WorldOptions& options, const std::string& file_for_messages) {
  for (const Generator& generator : kGenerators) {
    if (options.generator != generator.name) continue;
    Arrangement place(options, file_for_messages);
    if (options.plan_seed != 0 && !generator.has_plan_seed) {
      refuse(place.plan, "world", "plan_seed",
             std::to_string(options.plan_seed) + ": generator = " + options.generator +
                 " has one plan only; leave plan_seed out or take one of " + base::option_text::format(variedNames()));
    }
    if (!options.hall_wall.empty()) refuseUnknownMaterial(place.plan, "world", "hall_wall", options.hall_wall);
    generator.make(place, options);
    place.repeatSigns(options.repeated_signs);
    if (options.exit_signs) place.exitSigns();
    place.announcements(options.announcements);
    static const double groups[] = {0, 2, 5, 10};  // per square metre
    place.crowdSurfaces(groups[static_cast<int>(options.object_clutter)]);
    return std::move(place.plan);
  }
  const std::string near = base::nearestName(options.generator, generatorNames());
  throw base::Error(base::ExitCode::out_of_range, file_for_messages + ": [world] generator = " + options.generator +
                                                      ": there is no generator of that name" +
                                                      (near.empty() ? "" : "; did you mean '" + near + "'?") +
                                                      " Known: " + base::option_text::format(generatorNames()));
}

}  // namespace omnimapper::sim
