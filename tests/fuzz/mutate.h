#pragma once
#include <random>
#include <string>
#include <vector>

namespace spia::fuzz {

/// A file after one to four accidents: cut off, bytes and bits changed, pieces and lines lost,
/// doubled or moved, a word of the spice put in.
std::string damaged(std::string content, const std::vector<std::string>& spice, std::mt19937& random);

/// One number of a file changed: a digit, or all of it to another one of the file or to one at a
/// limit. What stands around it stays, so that files whose words are checked are read on.
std::string with_other_number(std::string content, std::mt19937& random);

} // namespace spia::fuzz
