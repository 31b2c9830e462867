#pragma once

#include <functional>
#include <string>

namespace omnimapper::source {

/// True if the file is compressed and its checksum says that every byte is as it was written. `stop` is asked
/// meanwhile, with the part that has been read in [0, 1]; if it is true, the answer is false.
bool isVerified(const std::string& path, const std::function<bool(double)>& stop);

}  // namespace omnimapper::source
