#include "app/viewer/model/document.h"

#include "app/viewer/model/names.h"

namespace spia::viewer {

std::string_view name(RegionKind kind) { return name_in_table(kind); }
RegionKind region_kind(std::string_view name) { return value_by_name<RegionKind>(name); }

} // namespace spia::viewer
