#pragma once

#include <omnimapper/map/MapFile.h>

#include <string>

#include "OddNumbers.h"

namespace omnimapper::fuzz {

/// A map with one to four errors in its sections: numbers, bytes, or a section that is missing, has another version or
/// is from another map. When it is written, its checksums are valid.
map::MapFile mutatedMap(const map::MapFile& map, const map::MapFile& other, Dice& dice);

/// A word to be put in place of a number, a name or a path.
std::string oddWord(Dice& dice);

/// A text of "key = value" lines or of numbers in columns, with one to four errors: values, keys, bytes, or lines that
/// are missing, repeated or moved.
std::string mutatedText(const std::string& text, Dice& dice);

/// A PNG with wrong numbers in its header or wrong bytes in its picture, and valid checksums.
std::string mutatedPng(const std::string& png, Dice& dice);

}  // namespace omnimapper::fuzz
