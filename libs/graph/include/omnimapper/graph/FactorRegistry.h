#pragma once

#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>

#include "omnimapper/graph/Factor.h"
#include "omnimapper/graph/Variable.h"

namespace omnimapper::graph {

/// The kinds of variables that a stored graph may hold, and a reader for each kind of factor.
class FactorRegistry {
 public:
  /// Reads what Factor::write() wrote. Throws Error(damaged_input) as the functions of ByteIo.h do.
  using Reader = std::function<std::shared_ptr<const Factor>(std::istream&)>;

  /// A registry with the kinds of VariableKinds.h, Between.h, Prior.h and PointFactor.h.
  static FactorRegistry withBuiltIns();

  /// Throws Error(internal) if the kind is registered already.
  void add(std::shared_ptr<const Variable> variable_kind);
  void add(const std::string& factor_kind, Reader reader);

  /// Throws Error(unregistered_class), naming the kind, if the kind is not registered.
  const std::shared_ptr<const Variable>& variable(const std::string& kind) const;
  std::shared_ptr<const Factor> readFactor(const std::string& kind, std::istream& in) const;

 private:
  std::map<std::string, std::shared_ptr<const Variable>> variables_;
  std::map<std::string, Reader> readers_;
};

}  // namespace omnimapper::graph
