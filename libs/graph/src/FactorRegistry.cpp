#include "omnimapper/graph/FactorRegistry.h"

#include <omnimapper/base/Error.h>

#include "omnimapper/graph/Between.h"
#include "omnimapper/graph/ByteIo.h"
#include "omnimapper/graph/PointFactor.h"
#include "omnimapper/graph/Prior.h"
#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph {

namespace {

[[noreturn]] void failUnknown(const std::string& what, const std::string& kind) {
  throw base::Error(
      base::ExitCode::unregistered_class,
      "graph: the kind of " + what + " \"" + kind +
          "\" is not registered: install the feature of OmniMapper that the map was made with, or name the "
          "library of the plugin that brings it in [mapper] plugin_libraries");
}

geometry::Se2 readSe2(std::istream& in) {
  return se2FromValue(readVector<3>(in).data());
}

geometry::Se3 readSe3(std::istream& in) {
  return se3FromValue(readVector<7>(in).data());
}

}  // namespace

FactorRegistry FactorRegistry::withBuiltIns() {
  FactorRegistry registry;
  for (const auto& kind : {se2(), se3(), point2(), point3(), panTilt()}) registry.add(kind);
  registry.add("between_se2", [](std::istream& in) { return std::make_shared<BetweenSe2>(readSe2(in)); });
  registry.add("between_se3", [](std::istream& in) { return std::make_shared<BetweenSe3>(readSe3(in)); });
  registry.add("prior_se2", [](std::istream& in) { return std::make_shared<PriorSe2>(readSe2(in)); });
  registry.add("prior_se3", [](std::istream& in) { return std::make_shared<PriorSe3>(readSe3(in)); });
  registry.add("prior_pan_tilt", [](std::istream& in) { return std::make_shared<PriorPanTilt>(readVector<2>(in)); });
  registry.add("point2_from_se2", [](std::istream& in) { return std::make_shared<PointFactor2>(readVector<2>(in)); });
  registry.add(std::string(SamePointFactor::kKind), SamePointFactor::read);
  registry.add("point3_from_se3", [](std::istream& in) { return std::make_shared<PointFactor3>(readVector<3>(in)); });
  return registry;
}

void FactorRegistry::add(std::shared_ptr<const Variable> variable_kind) {
  const std::string kind(variable_kind->kind());
  if (!variables_.emplace(kind, std::move(variable_kind)).second)
    throw base::Error(base::ExitCode::internal, "graph: the kind of variable \"" + kind + "\" is registered twice");
}

void FactorRegistry::add(const std::string& factor_kind, Reader reader) {
  if (!readers_.emplace(factor_kind, std::move(reader)).second)
    throw base::Error(base::ExitCode::internal,
                      "graph: the kind of factor \"" + factor_kind + "\" is registered twice");
}

const std::shared_ptr<const Variable>& FactorRegistry::variable(const std::string& kind) const {
  const auto found = variables_.find(kind);
  if (found == variables_.end()) failUnknown("variable", kind);
  return found->second;
}

std::shared_ptr<const Factor> FactorRegistry::readFactor(const std::string& kind, std::istream& in) const {
  const auto found = readers_.find(kind);
  if (found == readers_.end()) failUnknown("factor", kind);
  return found->second(in);
}

}  // namespace omnimapper::graph
