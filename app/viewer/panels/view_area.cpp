#include <algorithm>
#include <cmath>

#include "app/viewer/panels/labels.h"
#include "app/viewer/panels/view_tools.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/views/views.h"

namespace spia::viewer {
namespace {

/// The place under the mouse comes into the middle of the view, and is what the view turns about
/// from then on.
Camera centred(Frame& frame, View view, const Mouse& mouse, const Camera& camera)
{
    const RayPicker* picker = frame.pickers.ready_picker(frame.state.document.session, view);
    const auto kept = kept_in(frame.state.view, view);
    Camera result = pan(camera, mouse.size / 2. - mouse.pixel, mouse.size);
    if (!picker)
        return result;
    const RayHit hit = hit_at(camera, *picker, mouse.pixel, mouse.size, kept);
    if (hit.face < 0)
        return result;
    const Ray ray = ray_through(camera, picker->box(), mouse.pixel, mouse.size);
    const Eigen::Vector3d at = ray.origin + hit.distance * ray.direction;
    result.target = {at[0], at[1], at[2]};
    return result;
}

/// Turning, panning and zooming.
void navigate(Frame& frame, View view, const Mouse& mouse)
{
    const ImGuiIO& io = ImGui::GetIO();
    Ui& ui = frame.ui;
    const MouseStyle style = frame.state.view.mouse;
    Camera camera = frame.state.view.camera[size_t(view)];
    const Camera before = camera;
    if (ui.navigator.busy() ? ui.busy == view : mouse.inside && !ui.busy) {
        const bool left_is_free = frame.state.view.tool == Tool::look && !ui.dragged_corner;
        const Navigator::Step step =
            ui.navigator.follow(style, mouse_held(), mouse_pressed(), {io.MouseDelta.x, io.MouseDelta.y}, true,
                                left_is_free, click_slack * ui.scale);
        if (ui.navigator.busy())
            ui.busy = view;
        else if (ui.busy == view)
            ui.busy.reset();
        camera = step.centre ? centred(frame, view, mouse, camera) : moved(camera, step, mouse.size);
    }
    if (mouse.inside && io.MouseWheel != 0)
        camera = zoom(camera, wheel_factor(style), mouse.pixel, mouse.size);
    if (camera != before) {
        ViewSettings settings = frame.state.view;
        take_camera(settings, view, camera);
        frame.actions.push(SetViewSettings{settings});
    }
}

/// The cut of the section line, and the place of its plot that is under the mouse.
void draw_section(Frame& frame, View view, glm::dvec2 size, ImVec2 from, ImDrawList* draw)
{
    const Palette p = palette_of(frame.state.view.dark);
    const float s = frame.ui.scale;
    const ImU32 casing = IM_COL32(20, 24, 30, 200);
    const auto dot = [&](const Eigen::Vector3d& place) {
        const glm::dvec3 pixel = pixel_of(frame.state.view.camera[size_t(view)], place, size);
        return ImVec2(from.x + float(pixel.x), from.y + float(pixel.y));
    };
    const std::vector<SectionPiece>& pieces = section_in(frame, view);
    for (const auto& [colour, width] : {std::pair(casing, 4.5f * s), std::pair(ink(p.warning), 2 * s)})
        for (const SectionPiece& piece : pieces)
            draw->AddLine(dot(piece.from), dot(piece.to), colour, width);
    const auto& mark = frame.ui.section_mark;
    if (!mark || mark->frame + 1 < ImGui::GetFrameCount() || mark->place.piece >= pieces.size())
        return;
    const SectionPiece& piece = pieces[mark->place.piece];
    const ImVec2 middle = dot(piece.from + mark->place.share * (piece.to - piece.from));
    draw->AddCircleFilled(middle, 7 * s, casing);
    draw->AddCircleFilled(middle, 5 * s, ink(p.warning));
}

/// Over a picture that is to be replaced.
void veil(const Frame& frame, ImVec2 from, ImVec2 size, ImDrawList* draw)
{
    const Palette p = palette_of(frame.state.view.dark);
    draw->AddRectFilled(from, {from.x + size.x, from.y + size.y}, ink(ImVec4(p.panel.x, p.panel.y, p.panel.z, 0.75f)));
    constexpr const char* text = "Drawing...";
    const ImVec2 room = ImGui::CalcTextSize(text);
    draw->AddText({from.x + (size.x - room.x) / 2, from.y + (size.y - room.y) / 2}, ImGui::GetColorU32(ImGuiCol_Text),
                  text);
}

/// The face under the mouse: white on a dark casing, so that it is seen on every colour.
void mark_hovered(const Frame& frame, View view, const std::array<Eigen::Vector3d, 3>& corners, glm::dvec2 size,
                  ImVec2 from, ImDrawList* draw)
{
    const float s = frame.ui.scale;
    std::array<ImVec2, 3> at;
    for (size_t k = 0; k < 3; ++k) {
        const glm::dvec3 pixel = pixel_of(frame.state.view.camera[size_t(view)], corners[k], size);
        at[k] = {from.x + float(pixel.x), from.y + float(pixel.y)};
    }
    draw->AddTriangleFilled(at[0], at[1], at[2], IM_COL32(255, 255, 255, 90));
    draw->AddTriangle(at[0], at[1], at[2], IM_COL32(20, 24, 30, 230), 4 * s);
    draw->AddTriangle(at[0], at[1], at[2], IM_COL32(255, 255, 255, 255), 2 * s);
}

/// Where Return clicks with the tool.
void draw_cross(const Frame& frame, ImVec2 middle, ImDrawList* draw)
{
    const float s = frame.ui.scale, gap = 3 * s, arm = 12 * s;
    const Palette p = palette_of(frame.state.view.dark);
    for (const auto& [colour, width] : {std::pair(ink(p.panel), 4 * s), std::pair(ink(p.accent), 2 * s)})
        for (const ImVec2 way : {ImVec2(1, 0), ImVec2(-1, 0), ImVec2(0, 1), ImVec2(0, -1)})
            draw->AddLine({middle.x + gap * way.x, middle.y + gap * way.y},
                          {middle.x + arm * way.x, middle.y + arm * way.y}, colour, width);
}

/// The corner that the arrows move.
void mark_keyed_corner(const Frame& frame, glm::dvec2 size, ImVec2 from, ImDrawList* draw)
{
    const Session& session = frame.state.document.session;
    if (frame.state.view.tool != Tool::corners || !session.grid || !session.blank)
        return;
    const auto corners = frame.pickers.corners(session);
    if (!corners)
        return;
    const int vertex = (*corners)[size_t(frame.ui.keyed_corner)];
    const Eigen::Vector2d at = session.blank->blank.position.col(vertex);
    const glm::dvec3 pixel = pixel_of(frame.state.view.camera[size_t(View::blank)], {at[0], at[1], 0}, size);
    draw->AddCircle({from.x + float(pixel.x), from.y + float(pixel.y)}, 12 * frame.ui.scale,
                    ink(palette_of(frame.state.view.dark).accent), 32, 3 * frame.ui.scale);
}

bool is_refused(const Frame& frame, View view) { return view == View::part && shows_refused(frame.state); }

/// Whether what a view shows was made of other options; the quads follow a corner that is dragged.
bool shows_old(const Frame& frame, View view)
{
    return is_old(frame.state, view) && !frame.ui.dragged_corner && !is_refused(frame, view);
}

/// The line above a view. Two clicks on it make the view large, or small again.
void view_title(Frame& frame, View view, ImVec2 at, ImVec2 size)
{
    ImGui::PushFont(frame.ui.fonts.bold);
    ImGui::TextUnformatted(is_refused(frame, view)
                               ? ("Refused: " + frame.state.refused_file->file.filename().string()).c_str()
                               : title(view));
    ImGui::PopFont();
    ImGui::PushFont(frame.ui.fonts.small);
    if (shows_old(frame, view)) {
        ImGui::SameLine();
        ImGui::TextColored(palette_of(frame.state.view.dark).warning, "old");
        tooltip(frame.state.job.running ? "A new result is being computed"
                                        : "Options have changed since this was computed: Update all  (F5)");
    }
    view_buttons(frame, view);
    ImGui::PopFont();
    const bool in_title = ImGui::IsMouseHoveringRect(at, {at.x + size.x, at.y + size.y}) && ImGui::IsWindowHovered() &&
                          !ImGui::IsAnyItemHovered();
    if (in_title && ImGui::IsMouseDoubleClicked(0)) {
        ViewSettings settings = frame.state.view;
        settings.maximised = settings.maximised == view ? std::nullopt : std::optional(view);
        frame.actions.push(SetViewSettings{settings});
    }
}

/// Around places of the scene.
void draw_rings(const Frame& frame, View view, const Scene& shown, const glm::dvec2& size, ImVec2 from,
                ImDrawList* draw)
{
    const float scale = frame.ui.scale;
    const ImU32 halo = frame.state.view.dark ? IM_COL32(20, 24, 30, 210) : IM_COL32(255, 255, 255, 210);
    for (const SceneRing& ring : shown.rings) {
        if (cut_away(shown, ring.place))
            continue;
        const glm::dvec3 pixel = pixel_of(frame.state.view.camera[size_t(view)], ring.place, size);
        const ImVec2 middle{from.x + float(pixel.x), from.y + float(pixel.y)};
        draw->AddCircle(middle, 8 * scale, halo, 24, 5 * scale);
        draw->AddCircle(middle, 8 * scale, ink(palette_of(frame.state.view.dark).accent), 24, 2.5f * scale);
    }
}

/// What to do, in the middle of a view that has nothing to show.
void draw_empty(const Frame& frame, const std::string& words, ImVec2 from, ImVec2 size, ImDrawList* draw)
{
    if (words.empty())
        return;
    const float wrap = std::min(size.x - 40, 320 * frame.ui.scale);
    const ImVec2 text = ImGui::CalcTextSize(words.c_str(), nullptr, false, wrap);
    draw->AddText(nullptr, 0, {from.x + (size.x - text.x) / 2, from.y + (size.y - text.y) / 2},
                  ink(palette_of(frame.state.view.dark).muted), words.c_str(), nullptr, wrap);
}

/// The face under the mouse, legend, axes and labels, none over another; notes what they cover.
/// @returns where there is room for the cube
std::optional<PixelBox> draw_overlays(Frame& frame, View view, const Scene& shown, ImVec2 from, ImVec2 size,
                                      ImDrawList* draw)
{
    const glm::dvec2 pixels = dvec(size);
    if (shown.hovered)
        mark_hovered(frame, view, *shown.hovered, pixels, from, draw);
    std::vector<PixelBox> taken;
    const auto legend = draw_legend(frame, shown, from, size, draw);
    const auto triad = axis_triad(frame, view, legend, pixels, from, draw);
    const auto cube = cube_place(frame, view, pixels);
    for (const auto& box : {legend, triad, cube})
        if (box)
            taken.push_back(*box);
    if (!frame.ui.aside)
        frame.ui.covered[size_t(view)] = {legend ? legend->greatest.x : 0,
                                          cube ? std::max(pixels.x - cube->least.x, cube->greatest.y) : 0};
    for (const PixelBox& dot : measuring_dots(frame, view, pixels))
        taken.push_back(dot);
    draw_labels(frame, view, shown, from, size, taken, draw);
    return cube;
}

/// @returns whether the mouse points into it and drags nothing
bool one_view(Frame& frame, View view, ImVec2 at, ImVec2 whole)
{
    const Palette p = palette_of(frame.state.view.dark);
    const float bar = ImGui::GetTextLineHeight() + 10 * frame.ui.scale;
    ImGui::SetNextWindowPos(at);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * frame.ui.scale, 4 * frame.ui.scale});
    ImGui::BeginChild(title(view), whole, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
                          ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PopStyleVar();
    ImDrawList* draw = ImGui::GetWindowDrawList();
    view_title(frame, view, at, {whole.x, bar});

    const ImVec2 from{at.x, at.y + bar}, size{whole.x, std::max(1.f, whole.y - bar)};
    frame.ui.view_from[size_t(view)] = from;
    frame.ui.view_size[size_t(view)] = size;
    frame.events.resized(view, dvec(size), frame.ui.scale, frame.ui.covered[size_t(view)]);
    const Scene shown = scene(view, frame.state, frame.cache, size.y / frame.ui.scale);
    const ImVec2 dots = ImGui::GetIO().DisplayFramebufferScale;
    ImGui::SetCursorScreenPos(from);
    const DrawnView drawn =
        frame.draw(shown, view, std::max(1, int(size.x * dots.x)), std::max(1, int(size.y * dots.y)));
    ImGui::Image(drawn.texture, size, {0, 1}, {1, 0});
    const bool coloured_by_result = view != View::part || frame.state.document.display.field != Field::none;
    const bool live = view == View::blank && frame.state.job.running;
    if (shows_old(frame, view) && coloured_by_result && !live) // dimmed, until newer ones stand
        draw->AddRectFilled(from, {from.x + size.x, from.y + size.y},
                            ink(ImVec4(p.panel.x, p.panel.y, p.panel.z, 0.5f)));
    ImGui::SetCursorScreenPos(from);
    ImGui::InvisibleButton("canvas", size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    Mouse mouse{dvec(ImGui::GetMousePos()) - dvec(from), dvec(size), ImGui::IsItemHovered()};

    draw->PushClipRect(from, {from.x + size.x, from.y + size.y}, true);
    draw_rings(frame, view, shown, mouse.size, from, draw);
    draw_empty(frame, shown.empty, from, size, draw);
    if (frame.state.document.section && !is_refused(frame, view))
        draw_section(frame, view, mouse.size, from, draw);
    std::optional<PixelBox> cube;
    if (drawn.old && !live) // no legend, no label over another picture
        veil(frame, from, size, draw);
    else
        cube = draw_overlays(frame, view, shown, from, size, draw);
    if (cube && view_cube(frame, view, *cube, mouse, from, draw))
        mouse.inside = false;
    use_tool(frame, view, mouse, from, draw);
    if (frame.ui.focus == view && frame.ui.by_keys && tool_clicks(frame.state.view.tool))
        draw_cross(frame, {from.x + size.x / 2, from.y + size.y / 2}, draw);
    if (frame.ui.focus == view && frame.ui.by_keys && view == View::blank)
        mark_keyed_corner(frame, mouse.size, from, draw);
    draw->PopClipRect();
    navigate(frame, view, mouse);
    const bool points = mouse.inside && !ImGui::IsMouseDown(0) && !ImGui::IsMouseDown(1) && !ImGui::IsMouseDown(2);
    if (points)
        frame.events.hover(view, mouse.pixel, mouse.size, PickVertex{}.reach * frame.ui.scale);
    const bool clicked = ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2);
    if (clicked && ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem))
        frame.ui.focus = view, frame.ui.by_keys = false;
    ImGui::EndChild();
    const bool focus = frame.ui.focus == view;
    draw->AddRect(at, {at.x + whole.x, at.y + whole.y}, ink(focus ? p.accent : p.line), 0, 0,
                  (focus ? 2 : 1) * frame.ui.scale);
    return points;
}

/// A line between views that can be dragged. @returns the new share
float splitter(const Frame& frame, const char* id, ImVec2 at, ImVec2 size, bool vertical, float share, float start,
               float length)
{
    ImGui::SetCursorScreenPos(at);
    ImGui::InvisibleButton(id, size);
    if (ImGui::IsItemHovered() || ImGui::IsItemActive())
        ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    if (ImGui::IsItemActive()) {
        ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x, at.y + size.y},
                                                  ink(palette_of(frame.state.view.dark).accent));
        const ImVec2 mouse = ImGui::GetMousePos();
        return std::clamp(((vertical ? mouse.x : mouse.y) - start) / length, 0.15f, 0.85f);
    }
    return share;
}

/// Whatever was being dragged ends with the buttons, also where the tool or the part changed on the
/// way.
void end_drags(Frame& frame)
{
    if (ImGui::IsMouseDown(0) || ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2))
        return;
    Ui& ui = frame.ui;
    ui.busy.reset();
    ui.navigator.end();
    ui.cube_drag.reset();
    ui.trail.clear();
    if (frame.state.view.tool != Tool::measure || !frame.state.document.session.part ||
        ui.measuring.size() >= places_of(frame.state.view.measure))
        ui.measuring.clear();
    if (frame.state.view.tool != Tool::line || !frame.state.document.session.part)
        ui.line.clear();
    if (ui.dragged_corner && ui.corner_moved)
        if (const auto corners = frame.pickers.corners(frame.state.document.session))
            frame.actions.push(SetCorner{*ui.dragged_corner, (*corners)[size_t(*ui.dragged_corner)], false});
    ui.dragged_corner.reset();
    ui.corner_moved = false;
    if (ui.handle_drag && ui.handle_drag->moved)
        frame.actions.push(MoveHandles{ui.handle_drag->kind, Eigen::Vector3d::Zero(), false});
    ui.handle_drag.reset();
}

} // namespace

MouseHeld mouse_held()
{
    const ImGuiIO& io = ImGui::GetIO();
    return {ImGui::IsMouseDown(0), ImGui::IsMouseDown(2), ImGui::IsMouseDown(1), io.KeyShift, io.KeyCtrl};
}

bool mouse_pressed() { return ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2); }

double wheel_factor(MouseStyle style)
{
    constexpr double notch = 1.15; // larger
    return std::pow(notch, (forward_enlarges(style) ? 1 : -1) * ImGui::GetIO().MouseWheel);
}

void take_camera(ViewSettings& settings, View view, const Camera& camera)
{
    settings.camera[size_t(view)] = camera;
    if (settings.linked && view != View::blank)
        for (const View other : all_views)
            if (other != View::blank)
                settings.camera[size_t(other)] = camera;
}

void view_area(Frame& frame)
{
    const ImVec2 at = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
    if (ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2))
        frame.ui.focus.reset(); // unless a view is clicked
    bool points = false;        // what is under the mouse shows in all views, also those before the
                                // mouse's
    if (const auto only = frame.state.view.maximised) {
        if (!one_view(frame, *only, at, size))
            frame.events.hover_nothing();
        end_drags(frame);
        return;
    }
    const float gap = 4 * frame.ui.scale;
    ViewSettings settings = frame.state.view;
    const float x = std::floor(size.x * settings.split_x), y = std::floor(size.y * settings.split_y);
    const float split_x =
        splitter(frame, "split_x", {at.x + x - gap / 2, at.y}, {gap, size.y}, true, settings.split_x, at.x, size.x);
    const float split_y =
        splitter(frame, "split_y", {at.x, at.y + y - gap / 2}, {size.x, gap}, false, settings.split_y, at.y, size.y);
    if (split_x != settings.split_x || split_y != settings.split_y) {
        settings.split_x = split_x;
        settings.split_y = split_y;
        frame.actions.push(SetViewSettings{settings});
    }
    const float left = x - gap / 2, right = size.x - x - gap / 2, upper = y - gap / 2, lower = size.y - y - gap / 2;
    const auto place = [&](View view, float dx, float dy, float w, float h) {
        ImGui::SetCursorScreenPos({at.x + dx, at.y + dy});
        points |= one_view(frame, view, {at.x + dx, at.y + dy}, {w, h});
    };
    place(View::part, 0, 0, left, upper);
    place(View::blank, x + gap / 2, 0, right, upper);
    place(View::quads, 0, y + gap / 2, left, lower);
    place(View::surface, x + gap / 2, y + gap / 2, right, lower);
    if (!points)
        frame.events.hover_nothing();
    end_drags(frame);
}

} // namespace spia::viewer
