#pragma once
#include <filesystem>
#include <string_view>

namespace spia {

/// Writes the whole file or nothing: the content goes to a new file beside it, reaches the disk, and takes the name in
/// one step. Until then an older file of that name stays as it was; a link is followed and stays a link.
/// @throws ExchangeError with the path, the reason (folder missing, no permission, disk full, ...) and what to do;
///         nothing of the attempt is left behind
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// Whether a file could be written there, found out before the work that fills it. Leaves nothing behind.
/// @throws ExchangeError as write_atomically()
void require_writable(const std::filesystem::path& path);

} // namespace spia
