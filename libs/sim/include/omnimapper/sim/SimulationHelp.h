#pragma once

#include <string>

namespace omnimapper::sim {

/// The classes of sections that [world] names, and sensors with a sentence each, for --list.
std::string listClasses();
/// An INI section of a class of sensors with every option at its default, for --print-ini. Throws
/// Error(unknown_plugin).
std::string printIni(const std::string& class_name);
/// Markdown tables of all keys: ini/simulator.md is this text.
std::string iniReference();

}  // namespace omnimapper::sim
