#pragma once
#include <filesystem>
#include <string>

namespace spia {

/// The bytes of a file, read at once.
/// @throws InputError if it is no regular file, empty, larger than 3 GiB or cannot be read; the
/// name is not in the message
std::string file_content(const std::filesystem::path& path);

} // namespace spia
