#pragma once

namespace omnimapper::base {

/// Makes the C library keep up to 256 MiB of freed memory instead of returning it to the system. The system clears
/// every page that it gives out, which would take a quarter of the time of some extractors if each image got new pages.
/// Programs call this function at their start. It does nothing if the C library is not glibc.
void keepFreedMemory();

/// Throws Error(out_of_memory) if a limit set by the user (ulimit -v) leaves less memory than this process still needs.
/// Without this check OpenBLAS, whose threads allocate memory when they first work, would wait for that memory forever.
void requireAddressSpace();

}  // namespace omnimapper::base
