#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "app/viewer/model/document/scene.h"

/// Where texts stand in a view, so that they do not cover each other. All in pixels, from its upper
/// left corner.
namespace spia::viewer {

struct PixelBox {
    glm::dvec2 least{0}, greatest{0};

    friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

PixelBox around(glm::dvec2 middle, glm::dvec2 size);
PixelBox grown(PixelBox box, double by);
bool inside(const PixelBox& box, glm::dvec2 view);
bool meet(const PixelBox& a, const PixelBox& b);
bool meets_any(const PixelBox& box, const std::vector<PixelBox>& others);

/// A text that belongs to a place.
struct LabelWish {
    glm::dvec2 place; ///< where a dot is, or for the name of a region its middle
    glm::dvec2 size;  ///< of the text
    LabelKind kind = LabelKind::watched;
};

struct PlacedLabel {
    size_t wish = 0;
    PixelBox box;
    bool pushed = false; ///< so far from its place that a line must lead there
};

/// Watched places choose first, then corners, then regions; among these the earlier wish. Beside
/// its place, or in growing circles around it. Labels whose place is outside of the view, and those
/// for which there is no room, are left out.
/// @param taken  what no label may cover
/// @param scale  of the screen
/// @return in the order of the wishes
std::vector<PlacedLabel> place_labels(const std::vector<LabelWish>& wishes, glm::dvec2 view,
                                      const std::vector<PixelBox>& taken, double scale = 1);

} // namespace spia::viewer
