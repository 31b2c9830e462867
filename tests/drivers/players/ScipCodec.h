#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// Programs and classes with which tests and benchmarks play logs in place of sensors.
namespace omnimapper::players {

/// The encoding of SCIP 2.0, "Communication Protocol Specification for SCIP2.0 Standard", Hokuyo C-42-03320B: six bits
/// in a character, the highest first, plus 0x30.
std::string encodeScip(std::uint32_t value, int characters);

/// The checksum of a line: its bytes added up, the lowest six bits plus 0x30.
char scipSum(std::string_view line);

/// "LINE", its checksum, line feed.
std::string withScipSum(std::string_view line);

/// A line of information such as "DMIN:20": a semicolon, which the checksum leaves out, the checksum, line feed.
std::string scipInformation(std::string_view line);

/// Data in lines of 64 characters, each with its checksum and a line feed.
std::string scipBlock(std::string_view data);

}  // namespace omnimapper::players
