#pragma once

#include <omnimapper/map/MapFile.h>

#include <string>

#include "OddNumbers.h"

namespace omnimapper::fuzz {

/// A map with one to four things made wrong in its sections: numbers, bytes, a section left out, of another version, or
/// taken from another map. What is written of it has checksums that fit.
map::MapFile mutatedMap(const map::MapFile& map, const map::MapFile& other, Dice& dice);

/// A word that stands where a number, a name or a path should.
std::string oddWord(Dice& dice);

/// A text of "key = value" lines or of numbers in columns, with one to four things made wrong: values, keys, lines left
/// out, repeated or moved, bytes.
std::string mutatedText(const std::string& text, Dice& dice);

/// A PNG with numbers of its header or bytes of its picture made wrong, and checksums that fit.
std::string mutatedPng(const std::string& png, Dice& dice);

}  // namespace omnimapper::fuzz
