#pragma once

#include <omnimapper/testing/SimulatedLog.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace omnimapper::fuzz {

using testing::Dice;

/// A random number from 0 to end - 1; 0 if end is 0.
std::size_t below(Dice& dice, std::size_t end);
/// True with probability 1 / times.
bool onceIn(Dice& dice, int times);

/// Replacement for a number. More than half of the time it is derived from that number, so that gates may accept it,
/// else it is a value of a broken driver or an attacker: NaN, infinite, 0, negative, at the limit of a type, far too
/// large or far too small.
double oddInstead(double number, Dice& dice);

/// Replaces one number in the bytes, which is little-endian as in MRPT's files and in maps: a double whose value is
/// plausible for a measurement, or a small count of 4 bytes.
void changeNumber(std::string& bytes, Dice& dice);

/// Replaces, removes or inserts bytes: single ones, a few in a row, or numbers of 2, 4 or 8 bytes.
void damageBytes(std::string& bytes, Dice& dice);

}  // namespace omnimapper::fuzz
