#include "engine/mesh/solid/marks/mark_line.h"

namespace spia {

const char* name(MarkLabel::Kind kind)
{
    switch (kind) {
    case MarkLabel::Kind::mark: return "mark";
    case MarkLabel::Kind::countersink: return "countersink";
    case MarkLabel::Kind::counterbore: return "counterbore";
    }
    return "";
}

} // namespace spia
