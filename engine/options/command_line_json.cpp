#include "engine/options/command_line_json.h"

#include "engine/options/option.h"

namespace spia {

Json with_command_line_texts(Json json)
{
    if (json.is_string())
        return command_line_text(json.get_ref<const std::string&>());
    if (json.is_structured())
        for (Json& each : json)
            each = with_command_line_texts(std::move(each));
    return json;
}

} // namespace spia
