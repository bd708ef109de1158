#include "app/viewer/model/state.h"

#include "app/viewer/model/names.h"

namespace spia::viewer {

std::string_view name(View view) { return name_in_table(view); }
View view_by_name(std::string_view name) { return value_by_name<View>(name); }

std::string_view name(Tool tool) { return name_in_table(tool); }
Tool tool_by_name(std::string_view name) { return value_by_name<Tool>(name); }

const PartFile* examined(const ViewerState& state)
{
    return state.refused ? state.refused.get() : state.document.session.part.get();
}

} // namespace spia::viewer
