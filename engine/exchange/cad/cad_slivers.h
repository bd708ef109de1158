#pragma once
#include <TopoDS_Face.hxx>
#include <optional>

#include "engine/exchange/cad/read_cad.h"

namespace spia {

/// How wide a face is, if that is nowhere more than `most` (mm): every point of its border has
/// another side of it that near. The number of the face is not filled. For .cpp files of
/// engine/exchange that hold an OcctSession.
std::optional<CadSliver> sliver(const TopoDS_Face& face, double most);

} // namespace spia
