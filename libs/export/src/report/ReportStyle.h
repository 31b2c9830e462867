#pragma once

#include <string_view>

namespace omnimapper::exports {

/// The style sheet and the script that the report carries within it.
extern const std::string_view kReportStyle;
extern const std::string_view kReportScript;

}  // namespace omnimapper::exports
