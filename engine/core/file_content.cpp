#include "engine/core/file_content.h"

#include <fmt/core.h>
#include <fstream>

#include "engine/core/error.h"

namespace spia {

std::string file_content(const std::filesystem::path& path)
{
    namespace fs = std::filesystem;
    constexpr uintmax_t most_bytes = uintmax_t(3) << 30;
    std::error_code problem;
    const fs::file_status status = fs::status(path, problem);
    if (!fs::exists(status))
        throw InputError("there is no such file");
    if (!fs::is_regular_file(status))
        throw InputError("this is not a file but a folder or a device");
    const uintmax_t size = fs::file_size(path, problem);
    if (problem)
        throw InputError("its size cannot be found out: " + problem.message());
    if (size == 0)
        throw InputError("the file is empty");
    if (size > most_bytes)
        throw InputError(fmt::format("{} bytes are more than the {} that are read", size, most_bytes));
    std::string content(size_t(size), '\0');
    std::ifstream stream(path, std::ios::binary);
    if (!stream.read(content.data(), std::streamsize(size)))
        throw InputError("the file cannot be read; look at its permissions");
    return content;
}

} // namespace spia
