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
  std::string folder;  ///< made if missing
  std::string name;    ///< of the rawlog, without ".rawlog"
  int threads = 1;     ///< the bytes do not depend on it
};

/// What a run left.
struct SimulationResult {
  struct Count {
    std::string label;
    int measured = 0;  ///< in the log
    int dropped = 0;   ///< never arrived
    int unseen = 0;    ///< nothing in view that makes an observation
  };
  base::ExitCode code = base::ExitCode::ok;  ///< or interrupted: what was measured until then is written
  std::vector<Count> sensors;
  double duration = 0;  ///< simulated [s]
  double travel = 0;    ///< of the robot [m]
  /// How often pictures show the world's signs legibly; none without signs or pictures.
  std::optional<SignCounter> signs;
  std::vector<std::string> files;  ///< in the folder
  std::vector<std::string> warnings;
};
std::string toText(const SimulationResult& result, const std::string& folder);

/// Writes into the folder: <name>.rawlog (and <name>_Images), truth.tum (base poses at the stamp of every measurement),
/// landmarks.json, surfaces.json (flat surfaces with what the log saw of them, and openings), world.ply (the mesh of
/// all that is there at time 0), signs_seen.csv (the signs that each picture shows, SignTruth), truth/<label>.jsonl and
/// what sensors add, plan.svg, pictures/ of what each sensor saw in the middle of the run, <name>.ini and README.md,
/// which says what is what. Measurements stand in the order of their arrival. `stop` is asked between two of them. An
/// older run of the folder is kept until the new one is whole, and removed then. Throws Error unwritable_output (also
/// for a folder that holds things but no simulated log) or disk_full.
SimulationResult runSimulation(const Simulation& simulation, const SimulationRequest& request, base::Progress& progress,
                               const std::function<bool()>& stop = {});

}  // namespace omnimapper::sim
