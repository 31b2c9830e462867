#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/sim/Simulation.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::sim {

struct SimulationRequest {
  std::string folder;  ///< created if missing
  std::string name;    ///< of the rawlog, without ".rawlog"
  int threads = 1;     ///< the output is the same, bit for bit, for any number
};

/// What a run has written.
struct SimulationResult {
  struct Count {
    std::string label;
    int measured = 0;  ///< number in the log
    int dropped = 0;   ///< number that never arrived
    int unseen = 0;    ///< number without an observation, because nothing was in view
  };
  base::ExitCode code = base::ExitCode::ok;  ///< or interrupted: what was measured until then is written
  std::vector<Count> sensors;
  double duration = 0;  ///< simulated [s]
  double travel = 0;    ///< distance travelled by the robot [m]
  /// How often pictures show the world's signs legibly; none without signs or pictures.
  std::optional<SignCounter> signs;
  std::vector<std::string> files;  ///< in the folder
  std::vector<std::string> warnings;
};
std::string toText(const SimulationResult& result, const std::string& folder);

/// Writes into the folder: <name>.rawlog (and <name>_Images), truth.tum (base poses at the stamp of every measurement),
/// landmarks.json, surfaces.json (flat surfaces with the parts that the log shows, and openings), world.ply (the mesh
/// of all that is there at time 0), signs_seen.csv (the signs that each picture shows, SignTruth), objects.csv,
/// objects_seen.csv and objects/ (places, visibility and meshes of objects, TrueObjects), truth/<label>.jsonl and other
/// truth files of sensors, plan.svg, pictures/ of what each sensor saw in the middle of the run, <name>.ini and
/// README.md, which describes the files. Measurements are in the order of their arrival. `stop` is called before each
/// measurement; once it returns true, the run ends. An older run in the folder is kept until the new one is complete,
/// and then removed. Throws Error unwritable_output (also for a folder that holds files but no simulated log) or
/// disk_full.
SimulationResult runSimulation(const Simulation& simulation, const SimulationRequest& request, base::Progress& progress,
                               const std::function<bool()>& stop = {});

}  // namespace omnimapper::sim
