#pragma once

#include <string_view>

namespace omnimapper::plugins {

/// The style sheet and the script that are embedded in the report.
extern const std::string_view kReportStyle;
extern const std::string_view kReportScript;

}  // namespace omnimapper::plugins
