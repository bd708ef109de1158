#pragma once
#include "app/viewer/model/document/scene.h"

namespace spia::viewer {

/// Whether two scenes give the same picture; labels are not drawn here.
bool same_picture(const Scene& a, const Scene& b);

} // namespace spia::viewer
