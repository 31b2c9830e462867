#pragma once

#include <omnimapper/building/Storey.h>
#include <omnimapper/plugin/State.h>

#include <string>

namespace omnimapper::plugins {

/// The document scene_graph.json (doc/scene_graph.md): building, storey, rooms, doors, landmarks and places of a map as
/// nodes, and the relations contains, on, through and next to between them. Ids are those of the map, which a continued
/// map keeps.
std::string encodeSceneGraph(const mapper::State& state, const building::Storey& storey, const std::string& title);

}  // namespace omnimapper::plugins
