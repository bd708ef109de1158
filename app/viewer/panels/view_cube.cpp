#include <algorithm>
#include <cmath>

#include "app/viewer/panels/view_tools.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/views/label_layout.h"

namespace spia::viewer {
namespace {

// Pixels at content scale 1.
constexpr float large_cube = 88, small_cube = 66, cube_gap = 6;
constexpr float triad_size = 56;

/// Turned anyhow, the cube reaches hardly beyond its place: its corners are sqrt(3) half edges from
/// the middle.
float half_edge(const PixelBox& place) { return float(place.greatest.x - place.least.x) / (2 * 1.62f); }

ImVec4 mixed(const ImVec4& a, const ImVec4& b, float share)
{
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z), 1};
}

/// Text whose letters run along `right` and stand along `up`, in pixels of the screen, about a
/// middle.
void slanted_text(ImDrawList* draw, ImFont* font, const char* text, ImVec2 middle, glm::vec2 right, glm::vec2 up,
                  ImU32 colour)
{
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, text);
    // Letters outside of what is drawn on would be left out, so they are laid out in its corner and
    // moved then.
    const ImVec2 corner(std::ceil(draw->GetClipRectMin().x), std::ceil(draw->GetClipRectMin().y));
    const int first = draw->VtxBuffer.Size;
    draw->AddText(font, font->FontSize, corner, colour, text);
    for (int k = first; k < draw->VtxBuffer.Size; ++k) {
        ImVec2& at = draw->VtxBuffer[k].pos;
        const float x = at.x - corner.x - size.x / 2, y = at.y - corner.y - size.y / 2;
        at = {middle.x + right.x * x - up.x * y, middle.y + right.y * x - up.y * y};
    }
}

} // namespace

std::optional<PixelBox> cube_place(const Frame& frame, View view, glm::dvec2 size)
{
    const double s = frame.ui.scale;
    if (frame.state.view.camera[size_t(view)].flat || size.x < 200 * s || size.y < 150 * s)
        return std::nullopt;
    if (!frame.state.document.session.part && !frame.state.refused)
        return std::nullopt; // nothing to look at
    const double side = s * (size.x >= 320 * s && size.y >= 260 * s ? large_cube : small_cube);
    const glm::dvec2 corner(size.x - cube_gap * s, cube_gap * s);
    return PixelBox{{corner.x - side, corner.y}, {corner.x, corner.y + side}};
}

bool view_cube(Frame& frame, View view, const PixelBox& place, const Mouse& mouse, ImVec2 from, ImDrawList* draw)
{
    Ui& ui = frame.ui;
    const Camera& camera = frame.state.view.camera[size_t(view)];
    const Palette p = palette_of(frame.state.view.dark);
    const float edge = half_edge(place);
    const glm::dvec2 middle = (place.least + place.greatest) / 2.;
    const auto screen = [&](glm::dvec2 at) {
        return ImVec2(from.x + float(middle.x + edge * at.x), from.y + float(middle.y - edge * at.y));
    };
    const glm::dvec2 from_middle((mouse.pixel.x - middle.x) / edge, (middle.y - mouse.pixel.y) / edge);
    std::optional<CubeSide> under;
    if (mouse.inside && !ui.busy)
        under = cube_side_at(camera.turn, from_middle);
    const bool mine = ui.busy == view && ui.cube_drag;
    if (under && ImGui::IsMouseClicked(0)) {
        ui.busy = view;
        ui.cube_drag = CubeDrag{*under, mouse.pixel};
    } else if (mine) {
        CubeDrag& drag = *ui.cube_drag;
        drag.moved |= glm::length(mouse.pixel - drag.from) > click_slack * ui.scale;
        if (drag.moved && mouse.pixel != drag.from) {
            ViewSettings settings = frame.state.view;
            // Half a turn across the picture of the cube would be too quick for the hand.
            constexpr double slower = 2;
            take_camera(
                settings, view,
                orbit(camera, mouse.pixel - drag.from, glm::dvec2(slower * (place.greatest.x - place.least.x))));
            frame.actions.push(SetViewSettings{settings});
            drag.from = mouse.pixel;
        }
        if (!ImGui::IsMouseDown(0)) {
            if (!drag.moved)
                frame.actions.push(LookFromSide{view, drag.side});
            ui.cube_drag.reset();
            ui.busy.reset();
        }
    }
    const auto lit = mine && !ui.cube_drag ? std::nullopt
                     : ui.cube_drag && ui.busy == view
                         ? (ui.cube_drag->moved ? std::nullopt : std::optional(ui.cube_drag->side))
                         : under;
    const ImVec4 ground = frame.state.view.dark ? ImVec4(0.36f, 0.40f, 0.46f, 1) : ImVec4(0.93f, 0.945f, 0.965f, 1),
                 shade = frame.state.view.dark ? ImVec4(0.12f, 0.135f, 0.16f, 1) : ImVec4(0.62f, 0.66f, 0.72f, 1);
    for (const CubePiece& piece : cube_pieces(camera.turn)) {
        const ImVec4 plain = mixed(shade, ground, float(2 * piece.brightness - 1));
        const bool centre = std::abs(piece.side[0]) + std::abs(piece.side[1]) + std::abs(piece.side[2]) == 1;
        ImVec4 colour = centre ? plain : mixed(plain, shade, 0.22f);
        if (lit == piece.side)
            colour = mixed(colour, p.accent, 0.85f);
        ImVec2 corner[4];
        for (size_t k = 0; k < 4; ++k)
            corner[k] = screen(piece.corner[k]);
        std::reverse(corner, corner + 4); // clockwise on the screen, whose y runs down
        draw->AddConvexPolyFilled(corner, 4, ink(colour));
    }
    // outlines of the faces, over all pieces
    for (const CubePiece& piece : cube_pieces(camera.turn)) {
        const bool centre = std::abs(piece.side[0]) + std::abs(piece.side[1]) + std::abs(piece.side[2]) == 1;
        if (!centre)
            continue;
        ImVec2 corner[4];
        const glm::dvec2 heart = (piece.corner[0] + piece.corner[2]) / 2.;
        for (size_t k = 0; k < 4; ++k)
            corner[k] = screen(heart + (piece.corner[k] - heart) / cube_face_share);
        draw->AddPolyline(corner, 4, ink(shade), ImDrawFlags_Closed, ui.scale);
    }
    const ImVec4 letters = frame.state.view.dark ? ImVec4(0.95f, 0.96f, 0.98f, 1) : ImVec4(0.12f, 0.14f, 0.18f, 1);
    for (const CubeName& name : cube_names(camera.turn)) {
        // The longest name fills the face; letters are as large on all faces.
        ImFont* const font = ui.fonts.small;
        const float widest = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, "Bottom").x;
        const float fill = std::min(1.f, 1.62f * edge / widest);
        const glm::vec2 right(float(name.right.x) * fill, -float(name.right.y) * fill),
            up(float(name.up.x) * fill, -float(name.up.y) * fill);
        slanted_text(draw, font, name.name, screen(name.middle), right, up, ink(letters));
    }
    const auto corner = [&](glm::dvec2 at) { return ImVec2(from.x + float(at.x), from.y + float(at.y)); };
    if (!ui.aside) {
        const std::string called = "cube " + std::string(viewer::name(view));
        ui.items[called] = {corner(place.least), corner(place.greatest)};
    }
    if (under && !ui.busy && !ui.aside) { // beside the cube, which is what is being chosen from
        const std::string text = "Look from: " + words(*under);
        const float width = ImGui::CalcTextSize(text.c_str()).x + 2 * ImGui::GetStyle().WindowPadding.x;
        ImGui::SetNextWindowPos({std::max(0.f, corner(place.least).x - width - 4 * ui.scale), corner(place.least).y});
        ImGui::SetTooltip("%s", text.c_str());
    }
    return under.has_value() || mine;
}

std::optional<PixelBox> axis_triad(const Frame& frame, View view, const std::optional<PixelBox>& legend,
                                   glm::dvec2 size, ImVec2 from, ImDrawList* draw)
{
    const float s = frame.ui.scale;
    const Camera& camera = frame.state.view.camera[size_t(view)];
    if (camera.flat || size.x < 200 * s || size.y < 150 * s ||
        (!frame.state.document.session.part && !frame.state.refused))
        return std::nullopt;
    const double left = (legend ? legend->greatest.x : 0) + 6 * s;
    const PixelBox place{{left, size.y - (triad_size + 6) * s}, {left + triad_size * s, size.y - 6 * s}};
    const ImVec2 middle{from.x + float(place.least.x + place.greatest.x) / 2,
                        from.y + float(place.least.y + place.greatest.y) / 2};
    struct Axis {
        const char* name;
        glm::dvec3 way; ///< in the picture: right, up, towards the viewer
        ImVec4 colour;
    };
    const bool dark = frame.state.view.dark;
    const glm::dquat to_view = glm::conjugate(camera.turn);
    Axis axes[] = {
        {"X", to_view * glm::dvec3(1, 0, 0), dark ? ImVec4(0.95f, 0.38f, 0.36f, 1) : ImVec4(0.80f, 0.16f, 0.14f, 1)},
        {"Y", to_view * glm::dvec3(0, 1, 0), dark ? ImVec4(0.44f, 0.80f, 0.42f, 1) : ImVec4(0.12f, 0.52f, 0.16f, 1)},
        {"Z", to_view * glm::dvec3(0, 0, 1), dark ? ImVec4(0.45f, 0.66f, 1.00f, 1) : ImVec4(0.12f, 0.34f, 0.85f, 1)}};
    std::sort(std::begin(axes), std::end(axes), [](const Axis& a, const Axis& b) { return a.way.z < b.way.z; });
    const float arm = 0.33f * triad_size * s;
    ImFont* const font = frame.ui.fonts.small;
    for (const Axis& axis : axes) { // the farthest first
        const ImVec2 way{float(axis.way.x), -float(axis.way.y)};
        const ImVec2 tip{middle.x + arm * way.x, middle.y + arm * way.y};
        const float opacity = axis.way.z < -0.2 ? 0.55f : 1; // points away
        const ImU32 colour = ink(ImVec4(axis.colour.x, axis.colour.y, axis.colour.z, opacity));
        draw->AddLine(middle, tip, colour, 2 * s);
        const ImVec2 letter = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, axis.name);
        const float length = std::hypot(way.x, way.y), beyond = 8 * s;
        const ImVec2 away = length > 0.15f ? ImVec2(way.x / length, way.y / length) : ImVec2(0.7f, 0.7f);
        draw->AddText(font, font->FontSize,
                      {tip.x + beyond * away.x - letter.x / 2, tip.y + beyond * away.y - letter.y / 2}, colour,
                      axis.name);
    }
    return place;
}

} // namespace spia::viewer
