#include <every_header.h>

#include <iostream>

int main() {
  const auto stamp = omnimapper::base::parseUnix("1234567890.5");
  std::cout << omnimapper::base::formatUnix(stamp, 1) << "\n";
  return omnimapper::base::formatUnix(stamp, 1) == "1234567890.5" ? 0 : 1;
}
