#include "app/viewer/panels/view_tools.h"

#include <algorithm>

#include "app/viewer/model/picking/handles.h"
#include "app/viewer/model/picking/measuring.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {
namespace {

constexpr double click_reach = 8; ///< pixels at content scale 1: so near to a vertex a click means
                                  ///< it

/// The corners of the blank follow the mouse along the outline.
void drag_corners(Frame& frame, const Mouse& mouse)
{
    const Session& session = frame.state.document.session;
    Ui& ui = frame.ui;
    if (!session.blank)
        return;
    if (!session.grid) {
        if (mouse.inside && ImGui::IsMouseClicked(0) && !ui.busy)
            frame.events.say(Severity::hint, made_of_patches(session)
                                                 ? "Patches have corners of their own: choose \"one patch\" in the "
                                                   "step NURBS surface to choose four."
                                                 : "Make the grid first (F5); then its corners can be dragged.");
        return;
    }
    const auto corners = frame.pickers.corners(session);
    if (!corners)
        return;
    const Camera& camera = frame.state.view.camera[size_t(View::blank)];
    if (!ui.dragged_corner && mouse.inside && ImGui::IsMouseClicked(0) && !ui.busy)
        for (int k = 0; k < 4; ++k) {
            const Eigen::Vector2d at = session.blank->blank.position.col((*corners)[size_t(k)]);
            const glm::dvec3 pixel = pixel_of(camera, {at[0], at[1], 0}, mouse.size);
            if (glm::length(glm::dvec2(pixel) - mouse.pixel) < 14 * ui.scale) {
                ui.dragged_corner = ui.keyed_corner = k;
                ui.corner_taken_at = mouse.pixel;
            }
        }
    if (!ui.dragged_corner)
        return;
    const int vertex = nearest_boundary_vertex(frame.pickers.track(session), camera, mouse.pixel, mouse.size);
    const bool down = ImGui::IsMouseDown(0);
    const int now = (*corners)[size_t(*ui.dragged_corner)];
    ui.corner_moved |= glm::length(mouse.pixel - ui.corner_taken_at) > 3 * ui.scale;
    if (down && ui.corner_moved && vertex != now)
        frame.actions.push(SetCorner{*ui.dragged_corner, vertex, true});
    if (down)
        return;
    if (ui.corner_moved) // a click alone changes nothing
        frame.actions.push(SetCorner{*ui.dragged_corner, vertex, false});
    ui.dragged_corner.reset();
    ui.corner_moved = false;
}

/// Picked handles of the surface follow the mouse, in the plane of the picture; a click alone
/// picks.
void drag_handles(Frame& frame, View view, const Mouse& mouse)
{
    Ui& ui = frame.ui;
    if (view != View::surface || !frame.state.document.session.surface)
        return;
    const HandleKind kind = frame.state.view.handles;
    const Camera& camera = frame.state.view.camera[size_t(view)];
    auto& drag = ui.handle_drag;
    if (!drag && mouse.inside && ImGui::IsMouseClicked(0) && !ui.busy) {
        const PickHandle pick{kind, mouse.pixel, mouse.size, pick_mode(), PickHandle{}.reach * ui.scale};
        const Eigen::Matrix3Xd place = handle_positions(frame.state.document.session, kind);
        const auto found = handle_at(pick, camera, place);
        const std::vector<int>& picked =
            kind == HandleKind::control ? frame.state.document.controls : frame.state.document.lattice_points;
        // One that is picked already is taken with all the others.
        if (!found || pick.mode != PickMode::replace || !std::binary_search(picked.begin(), picked.end(), *found))
            frame.actions.push(pick);
        if (found && pick.mode != PickMode::remove)
            drag = HandleDrag{kind, mouse.pixel, mouse.pixel, place.col(*found)};
        return;
    }
    if (!drag)
        return;
    const bool down = ImGui::IsMouseDown(0);
    drag->moved |= glm::length(mouse.pixel - drag->from) > 3 * ui.scale;
    if (down && drag->moved && mouse.pixel != drag->at) {
        const Eigen::Vector3d now = place_beside(camera, drag->place, mouse.pixel - drag->at, mouse.size);
        frame.actions.push(MoveHandles{drag->kind, now - drag->place, true});
        drag->place = now;
        drag->at = mouse.pixel;
    }
}

/// Where the mouse went in a view, up to where it is.
std::vector<glm::dvec2> way_since_last_frame(const Ui& ui, const Mouse& mouse, ImVec2 from)
{
    std::vector<glm::dvec2> way;
    for (const glm::dvec2& place : ui.path)
        way.push_back(place - dvec(from));
    way.push_back(mouse.pixel);
    return way;
}

/// The place on the part under the mouse. A seam runs along edges: its places are vertices, where
/// it can those of the outline, since a seam that ends a little before it does not cut the part
/// open.
std::optional<Eigen::Vector3d> place_of_line(Frame& frame, View view, const Mouse& mouse)
{
    const Session& session = frame.state.document.session;
    const Camera& camera = frame.state.view.camera[size_t(view)];
    const TriMesh& part = session.part->mesh;
    Pickers& pickers = frame.pickers;
    const RayPicker* picker = pickers.picker(session, view);
    if (!picker)
        return std::nullopt;
    if (frame.ui.drawn_line == DrawnLine::seam) {
        const double reach = PickVertex{}.reach * frame.ui.scale;
        const auto nearest = [&](bool boundary, double within) {
            return pickers.vertex_at(session, {view, mouse.pixel, mouse.size, PickMode::replace, boundary, within},
                                     camera, kept_in(frame.state.view, view));
        };
        auto vertex = nearest(true, reach);
        if (!vertex)
            vertex = nearest(false, 5 * reach); // of a coarse mesh
        return vertex ? std::optional<Eigen::Vector3d>(part.position.col(*vertex)) : std::nullopt;
    }
    const auto hit = probe_at(camera, part, *picker, mouse.pixel, mouse.size, click_reach * frame.ui.scale,
                              kept_in(frame.state.view, view));
    return hit ? std::optional<Eigen::Vector3d>(part.position(Eigen::all, part.triangle.col(hit->face)) *
                                                hit->barycentric)
               : std::nullopt;
}

/// Why nothing can be measured in a view now; empty: it can.
std::string no_measuring(Frame& frame, View view)
{
    const ViewerState& state = frame.state;
    if (view == View::part && shows_refused(state))
        return "The file that was refused cannot be measured: go back to the part first, in the step Part.";
    if (view == View::part && step_position(state) > 0)
        return "A partly unfolded part cannot be measured: move the slider back to the formed part.";
    if (frame.pickers.measuring_mesh(state, view))
        return "";
    if (view == View::quads && made_of_patches(state.document.session))
        return "The quads of patches cannot be measured; measure in the view of the surface.";
    return "There is nothing to measure here yet.";
}

/// One more place of a measurement; with the last one it is made.
void measure_at(Frame& frame, View view, glm::dvec2 pixel, glm::dvec2 size)
{
    const ViewSettings& settings = frame.state.view;
    if (const std::string why = no_measuring(frame, view); !why.empty()) {
        frame.events.say(Severity::hint, why);
        return;
    }
    Pickers& pickers = frame.pickers;
    const RayPicker* picker = pickers.measuring_picker(frame.state, view);
    if (!picker)
        return;
    std::vector<Probe>& places = frame.ui.measuring;
    if (std::exchange(frame.ui.measuring_in, view) != view)
        places.clear(); // one measurement is in one picture
    // A face is meant as a whole, a place may be a vertex.
    const bool faces = settings.measure == MeasureKind::faces || settings.measure == MeasureKind::rounding;
    const double snap = faces ? 0 : click_reach * frame.ui.scale;
    const auto place = probe_at(settings.camera[size_t(view)], *pickers.measuring_mesh(frame.state, view), *picker,
                                pixel, size, snap, kept_in(settings, view));
    if (!place)
        return;
    places.push_back(*place);
    if (places.size() >= places_of(settings.measure))
        frame.actions.push(AddMeasurement{{settings.measure, std::exchange(places, {}), view}});
}

/// Where the places are that were clicked so far, pixels of the view.
std::vector<glm::dvec2> clicked_places(Frame& frame, View view, glm::dvec2 size)
{
    std::vector<glm::dvec2> pixels;
    if (frame.ui.measuring.empty() || frame.ui.measuring_in != view)
        return pixels;
    const TriMesh* mesh = frame.pickers.measuring_mesh(frame.state, view);
    for (const Probe& probe : frame.ui.measuring) {
        if (!mesh || probe.face >= mesh->triangles())
            return {};
        const Eigen::Vector3d place = mesh->position(Eigen::all, mesh->triangle.col(probe.face)) * probe.barycentric;
        pixels.emplace_back(pixel_of(frame.state.view.camera[size_t(view)], place, size));
    }
    return pixels;
}

/// The places clicked so far, and what the next click adds to them.
void draw_measuring(Frame& frame, View view, const Mouse& mouse, ImVec2 from, ImDrawList* draw)
{
    const Palette p = palette_of(frame.state.view.dark);
    const float s = frame.ui.scale;
    if (mouse.inside || view == View::part) {
        const auto cube = cube_place(frame, view, mouse.size);
        const float room = float(cube ? cube->least.x : mouse.size.x) - 20 * s;
        const std::string why = no_measuring(frame, view);
        ImFont* const font = frame.ui.fonts.small;
        draw->AddText(font, font->FontSize, {from.x + 10 * s, from.y + 8 * s}, ink(why.empty() ? p.accent : p.warning),
                      why.empty() ? advice(frame.state.view.measure) : why.c_str(), nullptr, room);
    }
    std::vector<ImVec2> shown;
    for (const glm::dvec2& place : clicked_places(frame, view, mouse.size))
        shown.push_back({from.x + float(place.x), from.y + float(place.y)});
    const size_t clicked = shown.size();
    if (!shown.empty() && mouse.inside)
        shown.push_back(ImGui::GetMousePos());
    for (const auto& [colour, width] : {std::pair(ink(p.panel), 4 * s), std::pair(ink(p.accent), 2 * s)})
        draw->AddPolyline(shown.data(), int(shown.size()), colour, ImDrawFlags_None, width);
    for (size_t k = 0; k < clicked; ++k) {
        draw->AddCircleFilled(shown[k], 5.5f * s, ink(p.panel));
        draw->AddCircleFilled(shown[k], 4 * s, ink(p.accent));
    }
}

/// A polyline on the part, place by place.
void draw_line(Frame& frame, View view, const Mouse& mouse, ImVec2 from, ImDrawList* draw)
{
    Ui& ui = frame.ui;
    if (view != View::part)
        return;
    const Camera& camera = frame.state.view.camera[size_t(view)];
    if (mouse.inside && ImGui::IsMouseDoubleClicked(0)) // its first click has set the last place
        end_line(frame);
    else if (mouse.inside && ImGui::IsMouseClicked(0) && !ui.busy) {
        if (const auto place = place_of_line(frame, view, mouse))
            ui.line.push_back(*place);
    }
    const ImU32 colour = ink(palette_of(frame.state.view.dark).accent);
    std::vector<ImVec2> shown;
    for (const Eigen::Vector3d& place : ui.line) {
        const glm::dvec3 pixel = pixel_of(camera, place, mouse.size);
        shown.push_back({from.x + float(pixel.x), from.y + float(pixel.y)});
        draw->AddCircleFilled(shown.back(), 4 * ui.scale, colour);
    }
    if (!shown.empty() && mouse.inside)
        shown.push_back(ImGui::GetMousePos());
    draw->AddPolyline(shown.data(), int(shown.size()), colour, ImDrawFlags_None, 2 * ui.scale);
}

} // namespace

std::vector<PixelBox> measuring_dots(Frame& frame, View view, glm::dvec2 size)
{
    std::vector<PixelBox> boxes;
    if (frame.state.view.tool == Tool::measure)
        for (const glm::dvec2& place : clicked_places(frame, view, size))
            boxes.push_back(around(place, glm::dvec2(13 * frame.ui.scale)));
    return boxes;
}

bool tool_clicks(Tool tool)
{
    return tool == Tool::pick || tool == Tool::flood || tool == Tool::smooth_region || tool == Tool::probe ||
           tool == Tool::vertex || tool == Tool::outline || tool == Tool::measure;
}

void click_with_tool(Frame& frame, View view, glm::dvec2 pixel, glm::dvec2 size)
{
    const ViewSettings& settings = frame.state.view;
    const Session& session = frame.state.document.session;
    if (!session.part)
        return;
    switch (settings.tool) {
    case Tool::pick:
    case Tool::flood:
    case Tool::smooth_region:
        frame.actions.push(PickAt{view, pixel, size, pick_mode(),
                                  settings.tool == Tool::flood ? std::optional(settings.flood_angle) : std::nullopt,
                                  settings.tool == Tool::smooth_region});
        return;
    case Tool::probe: {
        Pickers& pickers = frame.pickers;
        const RayPicker* picker = pickers.picker(session, view);
        if (!picker)
            return;
        if (const auto probe = probe_at(settings.camera[size_t(view)], *pickers.mesh(session, view), *picker, pixel,
                                        size, 0, kept_in(settings, view)))
            frame.actions.push(AddProbe{*probe});
        return;
    }
    case Tool::vertex:
    case Tool::outline:
        frame.actions.push(PickVertex{view, pixel, size, pick_mode(), settings.tool == Tool::outline,
                                      PickVertex{}.reach * frame.ui.scale});
        return;
    case Tool::measure: measure_at(frame, view, pixel, size); return;
    default: return;
    }
}

void use_tool(Frame& frame, View view, const Mouse& mouse, ImVec2 from, ImDrawList* draw)
{
    Ui& ui = frame.ui;
    const ViewSettings& settings = frame.state.view;
    if (view == View::blank && (settings.tool == Tool::corners || settings.tool == Tool::look))
        drag_corners(frame, mouse);
    if (settings.tool == Tool::look || settings.tool == Tool::corners || !frame.state.document.session.part)
        return;
    const bool clicked = mouse.inside && ImGui::IsMouseClicked(0) && !ui.busy;
    const Palette p = palette_of(settings.dark);
    switch (settings.tool) {
    case Tool::pick:
    case Tool::flood:
    case Tool::smooth_region:
    case Tool::probe:
    case Tool::vertex:
    case Tool::outline:
        if (clicked)
            click_with_tool(frame, view, mouse.pixel, mouse.size);
        return;
    case Tool::measure:
        if (clicked)
            click_with_tool(frame, view, mouse.pixel, mouse.size);
        draw_measuring(frame, view, mouse, from, draw);
        return;
    case Tool::shape: drag_handles(frame, view, mouse); return;
    case Tool::line: draw_line(frame, view, mouse, from, draw); return;
    case Tool::brush: {
        const double radius = settings.brush_radius * ui.scale; // pixels of the screen
        if (clicked) {
            ui.busy = view;
            ui.trail.clear();
        }
        if (mouse.inside)
            draw->AddCircle({from.x + float(mouse.pixel.x), from.y + float(mouse.pixel.y)}, float(radius),
                            ink(p.accent), 32, 1.5f * ui.scale);
        if (ui.busy == view && !ui.navigator.busy()) {
            const auto touch = [&](glm::dvec2 place) {
                const bool first = ui.trail.empty();
                frame.actions.push(PickBrush{view, place, radius, mouse.size,
                                             pick_mode() == PickMode::replace && !first ? PickMode::add : pick_mode(),
                                             settings.through});
                ui.trail = {place};
            };
            if (ui.trail.empty())
                touch(mouse.pixel);
            for (const glm::dvec2& place : way_since_last_frame(ui, mouse, from)) {
                const glm::dvec2 way = place - ui.trail[0], begin = ui.trail[0];
                const int touches = int(glm::length(way) / (0.5 * radius));
                for (int k = 1; k <= touches; ++k)
                    touch(begin + way * (double(k) / touches));
            }
            if (!ImGui::IsMouseDown(0)) {
                ui.trail.clear();
                ui.busy.reset();
            }
        }
        return;
    }
    case Tool::section:
        if (clicked) {
            ui.busy = view;
            ui.trail = {mouse.pixel};
        }
        if (ui.busy != view || ui.trail.empty())
            return;
        draw->AddLine({from.x + float(ui.trail[0].x), from.y + float(ui.trail[0].y)}, ImGui::GetMousePos(),
                      ink(p.accent), 2 * ui.scale);
        if (!ImGui::IsMouseDown(0)) {
            if (glm::length(ui.trail[0] - mouse.pixel) > 4 * ui.scale)
                frame.actions.push(DrawSection{view, ui.trail[0], mouse.pixel, mouse.size});
            ui.trail.clear();
            ui.busy.reset();
        }
        return;
    case Tool::box:
    case Tool::lasso:
        if (clicked) {
            ui.busy = view;
            ui.trail = {mouse.pixel};
        }
        if (ui.busy != view || ui.trail.empty())
            return;
        if (settings.tool == Tool::box) {
            const glm::dvec2 a = ui.trail[0], b = mouse.pixel;
            ui.trail = {a, {b.x, a.y}, b, {a.x, b.y}};
        } else
            for (const glm::dvec2& place : way_since_last_frame(ui, mouse, from))
                if (glm::length(ui.trail.back() - place) > 3)
                    ui.trail.push_back(place);
        {
            std::vector<ImVec2> shown;
            for (const glm::dvec2& point : ui.trail)
                shown.push_back({from.x + float(point.x), from.y + float(point.y)});
            draw->AddPolyline(shown.data(), int(shown.size()), ink(p.accent), ImDrawFlags_Closed, 1.5f * ui.scale);
        }
        if (!ImGui::IsMouseDown(0)) {
            frame.actions.push(PickArea{view, ui.trail, mouse.size, pick_mode(), settings.through});
            ui.trail.clear();
            ui.busy.reset();
        } else if (settings.tool == Tool::box)
            ui.trail.resize(1);
        return;
    default: return;
    }
}

} // namespace spia::viewer
