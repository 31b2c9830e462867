#pragma once

#include <omnimapper/plugin/View.h>

#include <set>
#include <string>

#include "ExtractionErrors.h"
#include "LevelEvidence.h"

namespace omnimapper::mapper {

/// What front end, back end and sessions share; plugins see it as a View.
struct RunState : ViewedRun {
  ExtractionErrors extraction_errors;
  LevelEvidence level_evidence;
  std::set<std::string> fed;  ///< sections of pose and measurement plugins that an observation came to
};

}  // namespace omnimapper::mapper
