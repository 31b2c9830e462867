#include "LabelledMapFile.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/map/LabelledPlaces.h>
#include <omnimapper/map/Layers.h>

#include <utility>

namespace omnimapper::query {

namespace {

const map::MapSection& sectionOf(const map::MapFile& file, const std::string& name, const std::string& path) {
  const auto* section = file.find(name);
  if (section) return *section;
  throw base::Error(base::ExitCode::unreadable_input, path + ": has no section \"" + name + "\", which labels need");
}

}  // namespace

LabelledMapFile LabelledMapFile::read(const std::string& path) {
  LabelledMapFile read;
  read.file = map::MapFile::read(path);
  read.places = map::Places::fromSection(sectionOf(read.file, map::Places::kLayer, path));
  if (const auto* labels = read.file.find(map::Labels::kLayer)) read.labels = map::Labels::fromSection(*labels);
  read.frames = map::framePosesFromSection(sectionOf(read.file, "frames", path));
  if (const auto* landmarks = read.file.find("landmarks")) read.current = map::currentLandmarks(*landmarks);
  return read;
}

void LabelledMapFile::write(const std::string& path) {
  std::map<base::KeyFrameId, geometry::Se3> poses;
  for (const auto& frame : frames) poses[frame.id] = geometry::fromMrpt(frame.map_from_base);
  const map::LabelAnchors anchors{[&](base::LandmarkId id) {
                                    const auto found = current.find(id);
                                    return found == current.end() ? id : found->second;
                                  },
                                  [&](const map::Label& label) -> Eigen::Vector3d {
                                    const auto frame = poses.find(label.frame);
                                    if (frame == poses.end())
                                      throw base::Error(base::ExitCode::unreadable_input,
                                                        path + ": a label refers to no key frame: damaged");
                                    return frame->second * label.in_frame;
                                  }};
  map::removeLabels(places.places);
  map::addLabels(labels, anchors, places.places);
  file.set(map::layerToSection(map::Places::kLayer, map::LayerOf<map::Places>(places)));
  if (labels.labels.empty() && !labels.question)
    file.remove(map::Labels::kLayer);
  else
    file.set(map::layerToSection(map::Labels::kLayer, map::LayerOf<map::Labels>(labels)));
  file.write(path);
}

}  // namespace omnimapper::query
