#pragma once

#include <omnimapper/net/Network.h>
#include <omnimapper/signs/TextReader.h>

#include <memory>

namespace omnimapper::signs {

/// Reads with a network that gives, at steps from left to right, the probability of each letter, as those of PaddleOCR
/// do (SVTR: Du, Chen, Jia et al., Scene text recognition with a single visual model, 2022).
class NetworkReader : public TextReader {
 public:
  /// Height and width of the network's input, whose shape is (1, 3, rows, columns).
  static constexpr int kRows = 48, kColumns = 320;

  /// `letters_file` has the letter of each class of the network, one a line, from class 1. Throws
  /// Error(unreadable_input), which names the file, if the letters cannot be read or do not fit the network, or if it
  /// is another network.
  NetworkReader(std::shared_ptr<const net::Network> network, const std::string& letters_file, const Alphabet& alphabet);

  /// A patch that is more than 6.6 times as wide as tall is compressed in width.
  Reading read(const camera::ColourImage& patch) const override;

 private:
  std::shared_ptr<const net::Network> network_;
  std::vector<std::string> letters_;  // of each class; empty if the alphabet has none for it
};

/// Decodes the text from the `probabilities` of all classes at each step (Graves: Connectionist temporal
/// classification, 2006). At each step the likeliest of the classes that have a letter is taken; a class that repeats
/// that of the step before gives no further letter, and class 0 separates two equal letters.
Reading decodeSteps(const float* probabilities, int steps, const std::vector<std::string>& letters);

}  // namespace omnimapper::signs
