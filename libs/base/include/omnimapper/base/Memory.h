#pragma once

namespace omnimapper::base {

/// Makes the C library keep up to 256 MiB of freed memory instead of returning it to the system, which would have to
/// clear its pages again for the next image; that takes a quarter of the time of some extractors. Programs call it at
/// their start. Does nothing if the C library is not glibc.
void keepFreedMemory();

/// Throws Error(out_of_memory) if a limit set by the user (ulimit -v) leaves less memory than this process still needs:
/// OpenBLAS, whose threads allocate their memory when they first work, would otherwise wait for it forever.
void requireAddressSpace();

}  // namespace omnimapper::base
