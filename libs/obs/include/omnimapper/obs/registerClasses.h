#pragma once

#include <mrpt/rtti/CObject.h>

#include <vector>

namespace omnimapper::obs {

/// Makes the observation classes of the project known to MRPT, so that a rawlog with them can be read. Loading the
/// library does it too; a program that mentions no class of it calls this, or its linker leaves the library out.
void registerClasses();

/// What registerClasses() registers.
const std::vector<const mrpt::rtti::TRuntimeClassId*>& allClasses();

}  // namespace omnimapper::obs
