#pragma once

#include <string>

namespace omnimapper::source {

/// What a file is that is no rawlog, and what to do about it, as the end of a sentence: "is a CARMEN log; import it
/// with ...".
std::string describeForeignFile(const std::string& path);

}  // namespace omnimapper::source
