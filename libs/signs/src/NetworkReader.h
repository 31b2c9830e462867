#pragma once

#include <omnimapper/net/Network.h>
#include <omnimapper/signs/TextReader.h>

#include <memory>

namespace omnimapper::signs {

/// Reads by a network that tells at steps from left to right how likely each letter is (SVTR: Du, Chen, Jia et al.,
/// Scene text recognition with a single visual model, 2022), as those of PaddleOCR do.
class NetworkReader : public TextReader {
 public:
  /// Height and width of what the network takes, (1, 3, rows, columns).
  static constexpr int kRows = 48, kColumns = 320;

  /// `letters_file`: the letter of each class of the network, one a line, from class 1. Throws Error(unreadable_input)
  /// with the file that is wrong: letters that cannot be read or are not those of the network, or another network.
  NetworkReader(std::shared_ptr<const net::Network> network, const std::string& letters_file, const Alphabet& alphabet);

  /// A patch that is more than 6.6 times as wide as tall is made narrower.
  Reading read(const perception::ColourImage& patch) const override;

 private:
  std::shared_ptr<const net::Network> network_;
  std::vector<std::string> letters_;  // of each class, empty where the alphabet has none for it
};

/// The text of a network's steps, `probabilities` of classes for each: the likeliest of those that have a letter at
/// each step, a class once where it is that of the step before, class 0 parting two (Graves: Connectionist temporal
/// classification, 2006).
Reading decodeSteps(const float* probabilities, int steps, const std::vector<std::string>& letters);

}  // namespace omnimapper::signs
