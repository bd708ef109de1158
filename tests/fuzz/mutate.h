#pragma once
#include <random>
#include <string>
#include <vector>

namespace spia::fuzz {

/// A file after one to four accidents: cut off, bytes and bits changed, pieces and lines lost, doubled or moved, a word of the
/// spice put in.
std::string damaged(std::string content, const std::vector<std::string>& spice, std::mt19937& random);

} // namespace spia::fuzz
