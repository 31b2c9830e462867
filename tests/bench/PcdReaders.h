#pragma once

namespace omnimapper::bench {

/// Prints how many damaged PCD files end the process, with our reader and with PCL's, and how long reading an intact
/// one takes. If PCL was not installed, prints a sentence that says so.
void comparePcdReaders();

}  // namespace omnimapper::bench
