#pragma once

#include <exception>
#include <string>

namespace omnimapper::base {

/// The message of an exception. For an exception by MRPT it is only the sentence, without source location and call
/// stack.
std::string sentenceOf(const std::exception& error);

}  // namespace omnimapper::base
