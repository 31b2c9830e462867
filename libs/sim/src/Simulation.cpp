#include <omnimapper/sim/Companions.h>
#include <omnimapper/sim/Drive.h>
#include <omnimapper/sim/Odometry.h>
#include <omnimapper/sim/Simulation.h>
#include <omnimapper/sim_world/WorldIni.h>

#include <algorithm>
#include <map>

#include "VisibleMoves.h"

namespace omnimapper::sim {

namespace {

// FNV-1a hash. A sensor's random streams depend on its name, so that another sensor in the list changes none of them.
std::uint64_t hashOf(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

double durationOf(const SimulationOptions& options, const Track& map_from_base) {
  const double arrival = map_from_base.places().back().time;
  return options.duration > 0 ? options.duration : arrival;
}

void refuseDoubleLabels(const base::Config& config, const std::vector<std::unique_ptr<Sensor>>& sensors,
                        const std::vector<std::string>& sections) {
  std::map<std::string, std::string> section_of;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const auto [first, is_new] = section_of.emplace(sensors[i]->label(), sections[i]);
    if (is_new) continue;
    throw base::Error(base::ExitCode::out_of_range, config.file() + ": [" + sections[i] +
                                                        "] label = " + sensors[i]->label() + " is also that of [" +
                                                        first->second + "]; give each sensor its own label");
  }
}

// The motion that a frame begins with is measured by one odometry.
void refuseUnframed(const base::Config& config, const std::vector<std::unique_ptr<Sensor>>& sensors) {
  const auto count = std::count_if(sensors.begin(), sensors.end(),
                                   [](const auto& sensor) { return dynamic_cast<const Odometry*>(sensor.get()); });
  if (count == 1) return;
  throw base::Error(base::ExitCode::out_of_range,
                    config.file() + ": [simulation] format = frames: needs one Odometry among the sensors, there are " +
                        std::to_string(count) + "; use format = observations");
}

}  // namespace

const base::OptionTable<SimulationOptions>& SimulationOptions::table() {
  static const auto table =
      base::OptionTable<SimulationOptions>()
          .integer("seed", &SimulationOptions::seed, {0, 2147483647}, "Seed of all random numbers in the measurements.")
          .number("duration_s", &SimulationOptions::duration, {0, kLongestRun},
                  "Time for which the sensors measure. 0 means until the robot has arrived.")
          .number("start_s", &SimulationOptions::start, {1e6, 4e9}, "Unix time at which the simulation begins.")
          .list("sensors", &SimulationOptions::sensors, "Names of the sections that describe the sensors.")
          .choice("format", &SimulationOptions::format,
                  {{"observations", Format::observations}, {"frames", Format::frames}},
                  "Format of the rawlog: single observations, or MRPT's pairs of actions and sensory frames.")
          .choice("images", &SimulationOptions::images,
                  {{"embedded", Images::embedded}, {"external", Images::external}},
                  "Where images are stored: in the rawlog, or in files beside it.");
  return table;
}

DrivenWorld readDrivenWorld(const base::Config& config) {
  const WorldPlan plan = readWorldPlan(config);
  World world = makeWorld(plan);
  Track map_from_base = planDrive(config, world);
  addCompanions(world, plan, map_from_base, config.section("robot").read<DriveOptions>().radius);
  return {std::move(world), std::move(map_from_base)};
}

Simulation::Simulation(const base::Config& config)
    : options_(config.section("simulation").read<SimulationOptions>()),
      driven_(readDrivenWorld(config)),
      scenes_(driven_.world),
      duration_(durationOf(options_, driven_.map_from_base)),
      ini_text_(config.text()) {
  validate(driven_.world);
  if (options_.sensors.empty()) {
    throw base::Error(base::ExitCode::out_of_range,
                      config.file() + ": [simulation] sensors is empty: name the sections of the sensors");
  }
  SensorContext context;
  context.seed = static_cast<std::uint64_t>(options_.seed);
  context.start = start();
  context.duration = duration_;
  context.world = &driven_.world;
  context.scenes = &scenes_;
  context.map_from_base = &driven_.map_from_base;
  for (const std::string& name : options_.sensors) {
    context.number = hashOf(name);
    sensors_.push_back(makeSensor(config, name, context));
  }
  refuseDoubleLabels(config, sensors_, options_.sensors);
  if (options_.format == SimulationOptions::Format::frames) refuseUnframed(config, sensors_);
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    if (sensors_[i]->count() == 0)
      warnings_.push_back(config.file() + ": [" + options_.sensors[i] + "] first_s is after the end of the run at " +
                          base::option_text::format(duration_) + " s; the sensor measures nothing");
  }
  for (const std::string& seen : visibleMoves(driven_.world, driven_.map_from_base, duration_))
    warnings_.push_back(config.file() + ": " + seen);
  config.refuseUnreadSections();
  const bool is_meant = config.placeOf("simulation", "sensors").rfind("--set", 0) == 0;
  if (const auto off = config.switchedOffPlugins(); !off.empty() && !is_meant) {
    warnings_.push_back(config.file() + ": no list of [simulation] or [world] names the sections " +
                        base::option_text::format(off) + ": they are switched off");
  }
}

}  // namespace omnimapper::sim
