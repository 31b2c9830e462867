#pragma once

#include <exception>
#include <string>

namespace omnimapper::base {

/// What an exception says; of one of MRPT's the sentence alone, without its place in the source and the call stack.
std::string sentenceOf(const std::exception& error);

}  // namespace omnimapper::base
