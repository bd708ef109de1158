#pragma once
#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/model/picking/camera.h"

/// The cube that shows from where a view looks, and turns it by a click: seen without perspective,
/// its middle in the middle of its picture. Lengths in half edges of the cube; pictures run right
/// and up.
namespace spia::viewer {

/// From the middle to a face (one number is not 0), an edge (two) or a corner (three): each -1, 0
/// or 1.
using CubeSide = std::array<int, 3>;

/// Share of a face that is the face itself; what is beyond belongs to its edges and corners.
inline constexpr double cube_face_share = 0.64;

/// What of the cube lies at a place of its picture. @param turn  as Camera::turn
std::optional<CubeSide> cube_side_at(const glm::dquat& turn, glm::dvec2 place);

/// A flat piece of a face: the face itself, or what of it belongs to an edge or a corner.
struct CubePiece {
    CubeSide side;
    std::array<glm::dvec2, 4> corner; ///< in the picture, around the piece
    double brightness;                ///< 0.5 to 1, as light from the viewer's shoulder makes it
};
/// All pieces that are seen.
std::vector<CubePiece> cube_pieces(const glm::dquat& turn);

/// Where the name of a face stands: its letters run along `right`, which is up to one half edge
/// long in the picture.
struct CubeName {
    const char* name;
    glm::dvec2 middle, right, up;
};
/// Of the faces that are seen well enough for their names to be read.
std::vector<CubeName> cube_names(const glm::dquat& turn);

/// "Front", "Top, right", ...
std::string words(const CubeSide& side);

/// Turns about the target so that the viewer stands where the side looks; z points up. @throws
/// InputError if it is none
Camera look_from(Camera camera, const CubeSide& side);

} // namespace spia::viewer
