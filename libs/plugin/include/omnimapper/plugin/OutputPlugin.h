#pragma once

#include <omnimapper/plugin/View.h>

namespace omnimapper::mapper {

/// Shows or writes the map (thesis 5.3.5).
class OutputPlugin {
 public:
  virtual ~OutputPlugin() = default;
  /// Whether what it writes is the map itself, which a run that localizes in one does not make anew.
  virtual bool isOfMap() const { return false; }
  /// After each solve, for what is shown live.
  virtual void update(const View& /*view*/) {}
  /// Once, at the end of the run. Throws base::Error if an output cannot be written.
  virtual void finish(const View& view) = 0;
};

}  // namespace omnimapper::mapper
