#pragma once

#include <string>

namespace omnimapper::sim {

/// The classes of the sections that [world] may name, and the classes of sensors with a sentence on each, for --list.
std::string listClasses();
/// An INI section of a class of sensors with every option at its default, for --print-ini. Throws
/// Error(unknown_plugin).
std::string printIni(const std::string& class_name);
/// Markdown tables of all keys: ini/simulator.md is this text.
std::string iniReference();

}  // namespace omnimapper::sim
