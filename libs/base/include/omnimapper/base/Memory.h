#pragma once

namespace omnimapper::base {

/// Has the C library keep up to 256 MiB of memory that was freed instead of handing it back to the system, which would
/// clear each page of it again for the next image: that costs a quarter of the time of some extractors. For programs,
/// at their start. Does nothing where the C library is not GNU's.
void keepFreedMemory();

/// Throws Error(out_of_memory) if a limit that the user has set (ulimit -v) leaves less than this process needs beside
/// what it holds: OpenBLAS, whose threads take their memory when they first work, would wait for it for ever.
void requireAddressSpace();

}  // namespace omnimapper::base
