#pragma once

#include <omnimapper/plugin/View.h>

#include <set>
#include <string>

#include "ExtractionErrors.h"

namespace omnimapper::mapper {

/// The data that front end, back end and session manager share; plugins see it through a View.
struct RunState : ViewedRun {
  ExtractionErrors extraction_errors;
  std::set<std::string> fed;  ///< sections of pose and measurement plugins that received an observation
};

}  // namespace omnimapper::mapper
