#include "engine/pipeline/shortcomings/unsuited_surface.h"

#include <fmt/core.h>

namespace spia {

std::optional<std::string> unsuited(const Certificate& certificate)
{
    if (!certificate.leak.empty())
        return "the patches leak: " + certificate.leak;
    for (size_t p = 0; p < certificate.patch.size(); ++p)
        if (const auto& refusal = certificate.patch[p].refusal)
            return (certificate.patch.size() == 1 ? "it " : fmt::format("patch {} ", p + 1)) + describe(*refusal);
    return std::nullopt;
}

} // namespace spia
