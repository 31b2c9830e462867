#pragma once

#include <mrpt/rtti/CObject.h>

#include <vector>

namespace omnimapper::obs {

/// Registers the observation classes of the project with MRPT, so that a rawlog with them can be read. Loading the
/// library registers them too, but a linker leaves the library out of a program that neither uses its classes nor calls
/// this function.
void registerClasses();

/// The classes that registerClasses() registers.
const std::vector<const mrpt::rtti::TRuntimeClassId*>& allClasses();

}  // namespace omnimapper::obs
