#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/base/OutputFolder.h>
#include <omnimapper/base/WorkerPool.h>
#include <omnimapper/geometry/TumLine.h>
#include <omnimapper/sim/SimulationRun.h>
#include <omnimapper/source/ExternalImages.h>

#include <algorithm>
#include <cctype>
#include <deque>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>
#include <tuple>

#include "FolderReadme.h"
#include "LogWriter.h"
#include "MeshFile.h"
#include "Pictures.h"
#include "SignTruth.h"
#include "SurfaceTruth.h"
#include "TrueObjects.h"
#include "TruthFolder.h"
#include "WorldTruth.h"

namespace omnimapper::sim {

namespace {

// Number of measurements that each thread makes ahead; many, because slow ones of cameras are rare among quick ones.
constexpr std::size_t kAhead = 32;
constexpr std::size_t kMostAheadBytes = 256 << 20;  // memory of all measurements that are made ahead

/// A measurement that arrives in the log.
struct Arrival {
  double time;  // [s]
  int sensor, k;
  bool operator<(const Arrival& other) const {
    return std::tie(time, sensor, k) < std::tie(other.time, other.sensor, other.k);
  }
};

std::vector<Arrival> arrivalsOf(const Simulation& simulation, std::vector<SimulationResult::Count>& counts) {
  std::vector<Arrival> arrivals;
  for (std::size_t s = 0; s < simulation.sensors().size(); ++s) {
    const Sensor& sensor = *simulation.sensors()[s];
    counts.push_back({sensor.label()});
    for (int k = 0; k < sensor.count(); ++k) {
      const double time = sensor.arrivalOf(k);
      if (time < 0)
        ++counts.back().dropped;
      else
        arrivals.push_back({time, static_cast<int>(s), k});
    }
  }
  std::sort(arrivals.begin(), arrivals.end());
  return arrivals;
}

/// Makes the measurements of a run on several threads and returns them in their order.
class Measurements {
 public:
  using Make = std::function<Measurement(const Arrival&)>;
  using Size = std::function<std::size_t(const Arrival&)>;
  Measurements(const std::vector<Arrival>& arrivals, int threads, Size size, Make make)
      : arrivals_(arrivals),
        ahead_(kAhead * static_cast<std::size_t>(threads)),
        size_(std::move(size)),
        make_(std::move(make)),
        pool_(threads) {}

  /// Number of measurements that have been returned or are being made ahead.
  std::size_t begun() const { return begun_; }
  Measurement next() {
    while (begun_ < arrivals_.size() && waiting_.size() < ahead_) {
      const Arrival& arrival = arrivals_[begun_];
      if (!waiting_.empty() && ahead_bytes_ + size_(arrival) > kMostAheadBytes) break;
      ahead_bytes_ += size_(arrival);
      ++begun_;
      waiting_.push_back(pool_.submit<Measurement>([this, &arrival] { return make_(arrival); }));
    }
    ahead_bytes_ -= size_(arrivals_[begun_ - waiting_.size()]);
    Measurement measurement = waiting_.front().get();
    waiting_.pop_front();
    return measurement;
  }

 private:
  const std::vector<Arrival>& arrivals_;
  const std::size_t ahead_;
  const Size size_;
  const Make make_;
  std::size_t begun_ = 0, ahead_bytes_ = 0;
  std::deque<std::future<Measurement>> waiting_;
  base::WorkerPool pool_;
};

std::string imageStem(const Sensor& sensor, int k) {
  const std::string number = std::to_string(k);
  return sensor.label() + "_" + std::string(number.size() < 6 ? 6 - number.size() : 0, '0') + number;
}

void writeText(const std::string& path, const std::string& text) {
  base::writeFile(path, [&](std::ostream& out) { out << text; });
}

std::string trajectoryOf(const Simulation& simulation, const std::set<base::Stamp>& stamps) {
  std::string text;
  for (const base::Stamp stamp : stamps) {
    const double time = base::secondsBetween(simulation.start(), stamp);
    text += geometry::tumLine(stamp, *simulation.mapFromBase().at(time));
  }
  return text;
}

double travelOf(const Track& track, double until) {
  double travel = 0;
  const auto& places = track.places();
  for (std::size_t i = 1; i < places.size() && places[i].time <= until; ++i)
    travel += (places[i].map_from_body->translation - places[i - 1].map_from_body->translation).norm();
  return travel;
}

// Removes the images of measurements that did not come into the log.
void removeImages(const std::string& folder, const std::vector<std::string>& stems) {
  std::vector<std::filesystem::path> unused;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    const auto isOf = [&](const std::string& stem) {
      return file.compare(0, stem.size(), stem) == 0 && !std::isdigit(static_cast<unsigned char>(file[stem.size()]));
    };
    if (std::any_of(stems.begin(), stems.end(), isOf)) unused.push_back(entry.path());
  }
  for (const auto& path : unused) std::filesystem::remove(path);
}

void writeLog(const Simulation& simulation, const SimulationRequest& request, const std::string& folder,
              base::Progress& progress, const std::function<bool()>& stop, TruthFolder& truth, SurfaceTruth& surfaces,
              SignTruth& signs, TrueObjects& objects, std::set<base::Stamp>& stamps, SimulationResult& result) {
  const auto arrivals = arrivalsOf(simulation, result.sensors);
  const std::string images = folder + "/" + request.name + "_Images";
  const bool is_external = simulation.options().images == SimulationOptions::Images::external;
  if (is_external) base::makeWritableFolder(images);
  const auto size = [&](const Arrival& arrival) { return simulation.sensors()[arrival.sensor]->sizeOfMeasurement(); };
  auto measurements = std::make_unique<Measurements>(arrivals, request.threads, size, [&](const Arrival& arrival) {
    const Sensor& sensor = *simulation.sensors()[arrival.sensor];
    Measurement measurement = sensor.measure(arrival.k);
    if (is_external && measurement.observation)
      source::moveImagesToFiles(*measurement.observation, images, imageStem(sensor, arrival.k));
    return measurement;
  });
  std::size_t done = 0;
  source::writeRawlog(
      folder + "/" + request.name + ".rawlog",
      [&](source::RawlogWriter& rawlog) {
        const auto log = makeLogWriter(simulation.options().format, rawlog);
        for (; done < arrivals.size(); ++done) {
          const Arrival& arrival = arrivals[done];
          if (stop && stop()) {
            result.code = base::ExitCode::interrupted;
            result.duration = arrival.time;
            break;
          }
          const Measurement measurement = measurements->next();
          const Sensor& sensor = *simulation.sensors()[arrival.sensor];
          auto& count = result.sensors[arrival.sensor];
          if (!measurement.observation) {
            ++count.unseen;
            continue;
          }
          ++count.measured;
          log->add(measurement.observation);
          truth.add(sensor, arrival.k, measurement);
          surfaces.add(measurement.seen, sensor.timeOf(arrival.k));
          signs.add(sensor, arrival.k, measurement.signs);
          objects.add(sensor, arrival.k, measurement.objects);
          stamps.insert(measurement.observation->timestamp);
          progress.report(arrival.time / simulation.duration(), "simulating " + request.name);
        }
        log->finish();
      },
      source::ColourImages::jpeg);
  const std::size_t begun = measurements->begun();
  measurements.reset();  // waits for measurements that are being made
  std::vector<std::string> unused;
  for (; is_external && done < begun; ++done)
    unused.push_back(imageStem(*simulation.sensors()[arrivals[done].sensor], arrivals[done].k));
  if (!unused.empty()) removeImages(images, unused);
}

// Refuses folders with files that are not from a simulation, so that they are not replaced. The README.md of a
// simulated log identifies its folder.
void refuseForeignFolder(const std::string& folder) {
  namespace fs = std::filesystem;
  if (!fs::is_directory(folder)) return;
  const bool is_empty = std::all_of(fs::directory_iterator(folder), fs::directory_iterator(),
                                    [](const auto& entry) { return entry.path().filename() == ".omnimapper"; });
  if (is_empty) return;
  std::ifstream page(fs::path(folder) / "README.md");
  std::string title;
  std::getline(page, title);
  if (!nameInTitle(title).empty()) return;
  throw base::Error(base::ExitCode::unwritable_output,
                    folder +
                        ": holds files but no simulated log, and they might be replaced; choose another with -o or "
                        "empty it");
}

// Writes log, truth and pictures into one folder.
SimulationResult simulateInto(const std::string& folder, const Simulation& simulation, const SimulationRequest& request,
                              base::Progress& progress, const std::function<bool()>& stop) {
  SimulationResult result;
  result.duration = simulation.duration();
  result.warnings = simulation.warnings();
  TruthFolder truth(folder);
  std::set<base::Stamp> stamps;
  SurfaceTruth surfaces(simulation.world());
  SignTruth signs(simulation);
  TrueObjects objects(simulation);
  writeLog(simulation, request, folder, progress, stop, truth, surfaces, signs, objects, stamps, result);
  truth.close();
  result.travel = travelOf(simulation.mapFromBase(), result.duration);
  result.files = {request.name + ".rawlog", "truth.tum", "landmarks.json", "surfaces.json", "world.ply", "plan.svg",
                  request.name + ".ini"};
  if (simulation.options().images == SimulationOptions::Images::external)
    result.files.push_back(request.name + "_Images/");
  if (signs.isWanted()) {
    result.files.push_back("signs_seen.csv");
    writeText(folder + "/signs_seen.csv", signs.table());
    result.signs = signs.counter();
  }
  for (const auto& file : objects.write(folder)) result.files.push_back(file);
  for (const auto& file : truth.files()) result.files.push_back(file);
  for (const auto& file : drawPictures(simulation, folder)) result.files.push_back(file);
  result.files.push_back("README.md");
  writeText(folder + "/truth.tum", trajectoryOf(simulation, stamps));
  writeText(folder + "/landmarks.json", landmarksJson(simulation));
  writeText(folder + "/surfaces.json", surfaces::toJson(surfaces.surfaces(request.name)));
  base::writeFile(folder + "/world.ply", [&](std::ostream& out) { writeMesh(out, simulation.world()); });
  writeText(folder + "/plan.svg", drawnPlan(simulation, result.duration));
  writeText(folder + "/" + request.name + ".ini", simulation.iniText());
  writeText(folder + "/README.md", folderReadme(simulation, request.name, result));
  return result;
}

}  // namespace

SimulationResult runSimulation(const Simulation& simulation, const SimulationRequest& request, base::Progress& progress,
                               const std::function<bool()>& stop) {
  if (!isPlainFileName(request.name)) {
    throw base::Error(
        base::ExitCode::command_line,
        "--name " + request.name + ": is used in file names; it must be text without '/' that does not begin with '.'");
  }
  refuseForeignFolder(request.folder);
  base::OutputFolder outputs(request.folder);
  outputs.open();
  SimulationResult result;
  try {
    result = simulateInto(outputs.staging(), simulation, request, progress, stop);
  } catch (const base::Error& error) {
    throw base::Error(error.code(), outputs.asTheUserSees(error.what()));
  }
  if (result.code != base::ExitCode::ok && outputs.holdsRun()) {
    outputs.commitInto("interrupted");
    result.warnings.push_back(request.folder + " is unchanged; what was simulated until now is in " + request.folder +
                              "/interrupted");
  } else {
    outputs.commit();
  }
  return result;
}

std::string toText(const SimulationResult& result, const std::string& folder) {
  std::ostringstream out;
  out << "simulated: " << base::fixed(result.duration, 1) << " s, " << base::fixed(result.travel, 1) << " m travelled"
      << (result.code == base::ExitCode::interrupted ? " (interrupted)" : "") << "\n";
  for (const auto& sensor : result.sensors) {
    out << "  " << sensor.label << ": " << sensor.measured << " measurements";
    if (sensor.dropped > 0) out << ", " << sensor.dropped << " lost";
    if (sensor.unseen > 0) out << ", " << sensor.unseen << " times nothing in view";
    out << "\n";
  }
  if (result.signs) {
    out << "  signs: " << result.signs->readings().size() << ", legible in three pictures or more "
        << result.signs->inPictures(3) << ", on two visits or more " << result.signs->onVisits(2) << "\n";
  }
  out << "in " << folder << ":";
  for (const auto& file : result.files) out << " " << file;
  out << "\n";
  return out.str();
}

}  // namespace omnimapper::sim
