#pragma once

#include <omnimapper/testing/SimulatedLog.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace omnimapper::fuzz {

using testing::Dice;

/// From 0 to end - 1; 0 where there is none.
std::size_t below(Dice& dice, std::size_t end);
/// True once in so many times.
bool onceIn(Dice& dice, int times);

/// In place of a number: half the time something like it, which a gate lets through, else what a broken driver or a
/// stranger would have there: no number, infinite, 0, negative, at the edge of a type, far too large or small.
double oddInstead(double number, Dice& dice);

/// Replaces a number among the bytes, little-endian as MRPT and maps have them: a double that looks like a measurement,
/// or a small count of 4 bytes.
void changeNumber(std::string& bytes, Dice& dice);

/// Replaces, removes or inserts some bytes: single ones, or whole numbers of 2, 4 and 8 bytes.
void damageBytes(std::string& bytes, Dice& dice);

}  // namespace omnimapper::fuzz
