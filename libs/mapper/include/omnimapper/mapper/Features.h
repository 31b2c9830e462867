#pragma once

namespace omnimapper::mapper {

/// Registers the observation classes and all plugin classes of the features of this build (base/FeatureLibraries.h).
/// Further calls do nothing.
void loadFeatures();

}  // namespace omnimapper::mapper
