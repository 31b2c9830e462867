#pragma once

namespace omnimapper::bench {

/// Prints how many damaged PCD files end the process, with our reader and with PCL's, and how long a whole one takes.
/// Without PCL a sentence says so.
void comparePcdReaders();

}  // namespace omnimapper::bench
