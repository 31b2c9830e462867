#pragma once

#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>

#include "omnimapper/graph/Factor.h"
#include "omnimapper/graph/Variable.h"

namespace omnimapper::graph {

/// What a stored graph may hold: kinds of variables, and how each kind of factor is read back.
class FactorRegistry {
 public:
  /// Reads what Factor::write() wrote; throws Error(damaged_input) as ByteIo.h does.
  using Reader = std::function<std::shared_ptr<const Factor>(std::istream&)>;

  /// The kinds of VariableKinds.h, Between.h, Prior.h and PointFactor.h.
  static FactorRegistry withBuiltIns();

  /// Throws Error(internal) if the kind is taken.
  void add(std::shared_ptr<const Variable> variable_kind);
  void add(const std::string& factor_kind, Reader reader);

  /// Throws Error(unregistered_class), naming the kind, if nobody registered it.
  const std::shared_ptr<const Variable>& variable(const std::string& kind) const;
  std::shared_ptr<const Factor> readFactor(const std::string& kind, std::istream& in) const;

 private:
  std::map<std::string, std::shared_ptr<const Variable>> variables_;
  std::map<std::string, Reader> readers_;
};

}  // namespace omnimapper::graph
