#include "engine/pipeline/files/seam_file.h"

#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/core/json_file.h"

namespace spia {

SeamOptions seam_options(const std::string& choice)
{
    if (choice == "auto")
        return {};
    if (choice == "none")
        return {SeamOptions::Mode::none};
    if (choice == "corners")
        return {SeamOptions::Mode::corners};
    const Json json = read_json(choice, true);
    const Place top(choice);
    if (!json.is_object() || json.size() != 1 || !json.contains("seam"))
        top.fail("must be an object with the member \"seam\" and no other");
    const Place paths = top.member("seam");
    const Json& list = json["seam"];
    if (!list.is_array() || list.empty())
        paths.fail("must be a list of paths [[12, 40], ...]");
    SeamOptions seam{SeamOptions::Mode::given};
    for (size_t i = 0; i < list.size(); ++i) {
        const Place path = paths.entry(i);
        if (!list[i].is_array() || list[i].size() < 2)
            path.fail("must be a list of two or more vertices");
        seam.path.emplace_back();
        for (size_t k = 0; k < list[i].size(); ++k) {
            const Json& vertex = list[i][k];
            if (!vertex.is_number_integer() || vertex.get<double>() < 0 || vertex.get<double>() > 2147483647)
                path.entry(k).fail("must be the number of a vertex, from 0");
            seam.path.back().push_back(vertex.get<int>());
        }
    }
    return seam;
}

} // namespace spia
