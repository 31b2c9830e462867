#pragma once

#include <omnimapper/matching/CloudMatcher.h>

#include <memory>

namespace omnimapper::plugins {

/// Registration of clouds by PCL (its ICP, ICP with normals and GICP) with the same limits as ours; how certain a match
/// is, is judged by our residuals. Throws Error(unknown_plugin) where this was built without PCL.
std::unique_ptr<const matching::CloudMatcher> pclMatcher(const matching::CloudMatcherOptions& options);

}  // namespace omnimapper::plugins
