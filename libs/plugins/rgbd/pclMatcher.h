#pragma once

#include <omnimapper/matching/CloudMatcher.h>

#include <memory>

namespace omnimapper::plugins {

/// Registration of clouds by PCL (its ICP, ICP with normals and GICP) with the limits of our own matcher. Our matcher
/// then judges the result and computes the uncertainty of the match from its residuals. Throws Error(unknown_plugin) in
/// a build without PCL.
std::unique_ptr<const matching::CloudMatcher> pclMatcher(const matching::CloudMatcherOptions& options);

}  // namespace omnimapper::plugins
