#include "FolderReadme.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/sim/Laser2d.h>

#include <algorithm>
#include <sstream>

#include "sensors/RgbdCamera.h"

namespace omnimapper::sim {

namespace {

const std::string kTitleBegin = "# ", kTitleEnd = ": a simulated log";

std::string meaningOf(const std::string& file, const std::string& name) {
  const auto ends = [&](const std::string& end) {
    return file.size() >= end.size() && file.compare(file.size() - end.size(), end.size(), end) == 0;
  };
  if (file == name + ".rawlog") return "what the sensors measured, in the order of arrival; MRPT's tools open it";
  if (file == name + "_Images/") return "images of the rawlog";
  if (file == name + ".ini") return "the INI that the log was made from; the same INI gives the same log, bit for bit";
  if (file == "truth.tum")
    return "true poses of the base in the map at the stamp of each measurement: stamp x y z qx qy qz qw";
  if (file == "landmarks.json")
    return "rooms, signs with text, markers, points, objects with their places over time, people, and every surface "
           "with its label, plane (normal . p + distance = 0) and outline, in the map";
  if (file == "surfaces.json")
    return "every flat surface over 0.05 m2 with its class, plane, outline and the part of it that was seen, and the "
           "openings between rooms; `omnimapper-eval map` compares a map with it";
  if (file == "world.ply") return "the whole place as a mesh, with label and class for each face";
  if (file == "signs_seen.csv")
    return "a line for each sign in each picture: its corners in pixels, the height of its capitals, the angle at "
           "which it is seen, how much of it is visible and whether it is legible";
  if (file == "objects.csv")
    return "a line for each object and each of its places: shape, extents, what it stands on, pose in the map, mesh";
  if (file == "objects_seen.csv")
    return "a line for each object in each image of a camera: the number of pixels that show it, those with a depth, "
           "the rectangle around them and their distance; `omnimapper-eval seen` counts them";
  if (file == "objects/") return "the mesh of each object in its own frame";
  if (file == "plan.svg") return "the world from above, with the robot's path";
  if (file == "README.md") return "this page";
  if (ends(".png"))
    return "what that sensor measured in the middle of the run; depth from blue to red, points from above";
  if (ends("_bodies.csv"))
    return "the beams of each scan of that sensor that ended on a person: successive beams in one line, with the name "
           "of "
           "the person and the body, which is a part of the person";
  if (ends(".jsonl"))
    return "the truth of each measurement of that sensor in the log, one line each, in the log's order";
  return "one file of ground truth for each measurement";
}

template <class Class>
bool has(const Simulation& simulation) {
  return std::any_of(simulation.sensors().begin(), simulation.sensors().end(),
                     [](const auto& sensor) { return dynamic_cast<const Class*>(sensor.get()) != nullptr; });
}

// What can be done with the log; each INI needs certain sensors.
std::string usesOf(const Simulation& simulation, const std::string& log) {
  std::string text = "See what is in it: `omnimapper-graphslam --check " + log + "`.\n";
  if (has<Laser2d>(simulation)) {
    text = "Map it: `omnimapper-graphslam -i laser2d.ini -r " + log +
           " -o OUT`, then\n`omnimapper-eval ate OUT/trajectory.tum truth.tum --align yaw -o OUT/eval`.\n";
  }
  if (has<RgbdCamera>(simulation))
    text += "Find its planes: `omnimapper-perceive -i perceive.ini -r " + log + " -o OUT/perceived.rawlog`.\n";
  return text;
}

}  // namespace

std::string folderReadme(const Simulation& simulation, const std::string& name, const SimulationResult& result) {
  std::ostringstream out;
  out << kTitleBegin << name << kTitleEnd << "\n\n"
      << (result.code == base::ExitCode::interrupted ? "Interrupted after " : "") << base::fixed(result.duration, 1)
      << " s, " << base::fixed(result.travel, 1) << " m travelled, seed " << simulation.options().seed
      << "; time 0 is Unix time " << base::fixed(simulation.options().start, 1) << ".\n\n"
      << "| file | what it is |\n|---|---|\n";
  for (const auto& file : result.files) out << "| `" << file << "` | " << meaningOf(file, name) << " |\n";
  out << "\n| sensor label | measurements | lost | nothing in view |\n|---|---|---|---|\n";
  for (const auto& sensor : result.sensors) {
    out << "| `" << sensor.label << "` | " << sensor.measured << " | " << sensor.dropped << " | " << sensor.unseen
        << " |\n";
  }
  out << "\nThe label of a surface is its number in `landmarks.json`; 0 is no surface.\n\n"
      << "![the world from above](plan.svg)\n\n"
      << usesOf(simulation, name + ".rawlog");
  return out.str();
}

std::string nameInTitle(const std::string& line) {
  const std::size_t around = kTitleBegin.size() + kTitleEnd.size();
  if (line.size() <= around || line.compare(0, kTitleBegin.size(), kTitleBegin) != 0 ||
      line.compare(line.size() - kTitleEnd.size(), kTitleEnd.size(), kTitleEnd) != 0)
    return "";
  const std::string name = line.substr(kTitleBegin.size(), line.size() - around);
  return isPlainFileName(name) ? name : "";
}

}  // namespace omnimapper::sim
