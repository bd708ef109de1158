#pragma once
#include <algorithm>
#include <cassert>
#include <filesystem>
#include <string_view>
#include <vector>

/// The tables of readers: a row is a format and what reads it.
namespace spia {

/// A format that parts are read from.
struct FileFormat {
    std::string_view name;                 ///< as people know it: "STEP"
    std::vector<std::string_view> endings; ///< of its files, in lower case, with their dot
};

bool has_ending(const FileFormat& format, const std::filesystem::path& path);

template <class Read> struct FormatReader {
    FileFormat format;
    Read read;
};

template <class Read> std::vector<FileFormat> formats_of(const std::vector<FormatReader<Read>>& readers)
{
    std::vector<FileFormat> formats;
    for (const FormatReader<Read>& each : readers)
        formats.push_back(each.format);
    return formats;
}

/// What reads the file, whose ending has to be that of one of the formats.
template <class Read> Read reader_of(const std::vector<FormatReader<Read>>& readers, const std::filesystem::path& path)
{
    const auto found = std::ranges::find_if(readers, [&](const auto& each) { return has_ending(each.format, path); });
    assert(found != readers.end());
    return found->read;
}

} // namespace spia
