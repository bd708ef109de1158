#include "app/viewer/model/picking/view_cube.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "engine/core/error.h"

namespace spia::viewer {
namespace {

struct Face {
    const char* name;
    glm::dvec3 normal, right, up; ///< as it is read from outside
};
constexpr double one = 1;
const std::array<Face, 6> faces = {{{"Top", {0, 0, one}, {one, 0, 0}, {0, one, 0}},
                                    {"Bottom", {0, 0, -one}, {one, 0, 0}, {0, -one, 0}},
                                    {"Front", {0, -one, 0}, {one, 0, 0}, {0, 0, one}},
                                    {"Back", {0, one, 0}, {-one, 0, 0}, {0, 0, one}},
                                    {"Left", {-one, 0, 0}, {0, -one, 0}, {0, 0, one}},
                                    {"Right", {one, 0, 0}, {0, one, 0}, {0, 0, one}}}};

int sign_of(double along) { return along > cube_face_share ? 1 : along < -cube_face_share ? -1 : 0; }

glm::dvec2 in_picture(const glm::dquat& turn, const glm::dvec3& place)
{
    return glm::dvec2(glm::conjugate(turn) * place);
}

} // namespace

std::optional<CubeSide> cube_side_at(const glm::dquat& turn, glm::dvec2 place)
{
    // The line of sight comes from far in front; it enters the cube through the last of the three
    // faces towards the viewer.
    const glm::dvec3 origin = turn * glm::dvec3(place, 0), back = turn * glm::dvec3(0, 0, 1);
    double enters = std::numeric_limits<double>::infinity(), leaves = -enters; // along `back`
    for (int k = 0; k < 3; ++k) {
        if (std::abs(back[k]) < std::numeric_limits<double>::epsilon()) {
            if (std::abs(origin[k]) > 1)
                return std::nullopt;
            continue;
        }
        const double a = (1 - origin[k]) / back[k], b = (-1 - origin[k]) / back[k];
        enters = std::min(enters, std::max(a, b));
        leaves = std::max(leaves, std::min(a, b));
    }
    if (!(enters >= leaves))
        return std::nullopt;
    const glm::dvec3 hit = origin + enters * back;
    return CubeSide{sign_of(hit.x), sign_of(hit.y), sign_of(hit.z)};
}

std::vector<CubePiece> cube_pieces(const glm::dquat& turn)
{
    std::vector<CubePiece> pieces;
    const glm::dvec3 light = glm::normalize(glm::dvec3(-0.35, 0.55, 0.8)); // as in mesh.frag
    constexpr std::array<double, 4> cut = {-1, -cube_face_share, cube_face_share, 1};
    for (const Face& face : faces) {
        const glm::dvec3 seen = glm::conjugate(turn) * face.normal;
        constexpr double edge_on = 1e-3;
        if (seen.z <= edge_on)
            continue;
        const double brightness = 0.5 + 0.5 * std::max(0., glm::dot(seen, light));
        for (size_t i = 0; i < 3; ++i)
            for (size_t j = 0; j < 3; ++j) {
                const glm::dvec3 way = face.normal + (double(i) - 1) * face.right + (double(j) - 1) * face.up;
                const auto at = [&](double x, double y) {
                    return in_picture(turn, face.normal + x * face.right + y * face.up);
                };
                pieces.push_back(
                    {{int(std::lround(way.x)), int(std::lround(way.y)), int(std::lround(way.z))},
                     {at(cut[i], cut[j]), at(cut[i + 1], cut[j]), at(cut[i + 1], cut[j + 1]), at(cut[i], cut[j + 1])},
                     brightness});
            }
    }
    return pieces;
}

std::vector<CubeName> cube_names(const glm::dquat& turn)
{
    constexpr double readable = 0.3; // of the face's height is left
    std::vector<CubeName> names;
    for (const Face& face : faces)
        if ((glm::conjugate(turn) * face.normal).z > readable)
            names.push_back(
                {face.name, in_picture(turn, face.normal), in_picture(turn, face.right), in_picture(turn, face.up)});
    return names;
}

std::string words(const CubeSide& side)
{
    std::string text;
    for (const Face& face : faces)
        if (glm::dot(face.normal, glm::dvec3(side[0], side[1], side[2])) > 0) {
            std::string name = face.name;
            if (!text.empty())
                name[0] = char(std::tolower(static_cast<unsigned char>(name[0])));
            text += (text.empty() ? "" : ", ") + name;
        }
    return text;
}

Camera look_from(Camera camera, const CubeSide& side)
{
    const glm::dvec3 way(side[0], side[1], side[2]);
    if (side == CubeSide{0, 0, 0} || glm::any(glm::greaterThan(glm::abs(way), glm::dvec3(1))))
        throw InputError("A side of the view cube has three numbers from -1, 0 and 1, not all of them 0.");
    if (camera.flat)
        return look(camera, StandardView::top);
    if (side[0] == 0 && side[1] == 0)
        return look(camera, side[2] > 0 ? StandardView::top : StandardView::bottom);
    const glm::dvec3 viewer = glm::normalize(way), right = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), viewer));
    camera.turn = glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(viewer, right), viewer)));
    return camera;
}

} // namespace spia::viewer
