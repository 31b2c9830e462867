#pragma once

#include <omnimapper/sim_world/Body.h>
#include <omnimapper/sim_world/MeshBuilder.h>

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// A material by name, and how its texture lies.
struct NamedMaterial {
  Material material;
  TextureLayout layout;
};

/// Names of all materials: paints, woods, metals, cloths, glass, grounds.
const std::vector<std::string>& materialNames();
/// For messages: there is none of that name, but there are others.
std::string sayUnknownMaterial(const std::string& name);
/// None if nothing is called so.
std::optional<NamedMaterial> findMaterial(const std::string& name);
/// Throws base::Error(out_of_range) with the nearest name.
NamedMaterial materialNamed(const std::string& name);

}  // namespace omnimapper::sim
