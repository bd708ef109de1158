#include "engine/exchange/file_format.h"

#include <string>

#include "engine/core/text.h"

namespace spia {

bool has_ending(const FileFormat& format, const std::filesystem::path& path)
{
    return std::ranges::find(format.endings, lower_case(path.extension().string())) != format.endings.end();
}

} // namespace spia
