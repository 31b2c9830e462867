#pragma once

namespace omnimapper::exports {

/// Registers every output plugin with MRPT. May be called twice.
void registerOutputs();

}  // namespace omnimapper::exports
