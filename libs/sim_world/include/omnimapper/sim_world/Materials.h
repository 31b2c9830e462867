#pragma once

#include <omnimapper/sim_world/Body.h>
#include <omnimapper/sim_world/MeshBuilder.h>

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// A material and the layout of its texture.
struct NamedMaterial {
  Material material;
  TextureLayout layout;
};

/// Names of all materials: paints, woods, metals, cloths, glass, grounds.
const std::vector<std::string>& materialNames();
/// Text for messages that says that no material has that name, with the nearest name or all names.
std::string sayUnknownMaterial(const std::string& name);
/// None if there is no material of that name.
std::optional<NamedMaterial> findMaterial(const std::string& name);
/// Throws base::Error(out_of_range) with the nearest name.
NamedMaterial materialNamed(const std::string& name);

}  // namespace omnimapper::sim
