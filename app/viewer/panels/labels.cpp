#include "app/viewer/panels/labels.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <utility>

#include "app/viewer/model/picking/picking.h"
#include "app/viewer/panels/ui.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/views/colour_scale.h"

namespace spia::viewer {

bool cut_away(const Scene& scene, const Eigen::Vector3d& place)
{
    // A hair's breadth beyond the plane counts as on it.
    return scene.kept && scene.kept->height(place) < -1e-9 * std::max(1., scene.box.diagonal().norm());
}

namespace {

/// From here on the values of isolines wait until the camera stands still.
constexpr int many_triangles = 200000;

glm::dvec2 extent(ImFont* font, const std::string& text)
{
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, text.c_str());
    return {size.x, size.y};
}

/// Whether the sheet of a view lies in front of a place: by the first face on the line of sight.
Hidden hidden_in(Frame& frame, View view, glm::dvec2 size)
{
    const bool of_other = view == View::part && shows_refused(frame.state);
    const RayPicker* picker =
        view == View::blank || of_other ? nullptr : frame.pickers.ready_picker(frame.state.document.session, view);
    if (!picker) // a flat sheet hides nothing
        return [](const glm::dvec3&) { return false; };
    const Camera& camera = frame.state.view.camera[size_t(view)];
    const auto kept = kept_in(frame.state.view, view);
    // mm; grids lie that near to the part
    const double touching = 0.004 * picker->box().diagonal().norm();
    return [&camera, picker, size, touching, kept](const glm::dvec3& place) {
        const Ray ray = ray_through(camera, picker->box(), glm::dvec2(place), size);
        const RayHit hit = hit_at(camera, *picker, glm::dvec2(place), size, kept);
        return hit.face >= 0 &&
               pixel_of(camera, ray.origin + hit.distance * ray.direction, size).z > place.z + touching;
    };
}

/// What is left of isolines: each stretch that is not interrupted.
std::vector<Isoline> kept_lines(const std::vector<Isoline>& lines, const HalfSpace& half)
{
    std::vector<Isoline> kept;
    for (const Isoline& line : lines)
        for (Eigen::Index begin = 0, end; begin < line.point.cols(); begin = end + 1) {
            for (end = begin; end < line.point.cols() && half.height(line.point.col(end)) >= 0; ++end)
                ;
            if (end - begin > 1)
                kept.push_back({line.value, line.point.middleCols(begin, end - begin)});
        }
    return kept;
}

void find_places(Frame& frame, View view, const Scene& scene, glm::dvec2 size, bool with_values,
                 std::vector<PixelBox> taken, LabelPlaces& places)
{
    const Camera& camera = frame.state.view.camera[size_t(view)];
    const Hidden hidden = hidden_in(frame, view, size);
    // no label stands outside of the view
    const glm::dvec2 nowhere(-std::numeric_limits<double>::max());
    std::vector<LabelWish> wishes;
    for (const SceneLabel& label : scene.labels)
        wishes.push_back({cut_away(scene, label.place) ? nowhere : glm::dvec2(pixel_of(camera, label.place, size)),
                          extent(frame.ui.fonts.text, label.text), label.kind});
    constexpr Eigen::Index few = 64; // dots that mean something each, not a net
    for (const auto& points : scene.points)
        if (points->on_top && points->point.cols() <= few)
            for (Eigen::Index i = 0; i < points->point.cols(); ++i) {
                const Eigen::Vector3d place = points->origin + points->point.col(i).cast<double>();
                if (!cut_away(scene, place))
                    taken.push_back(around(glm::dvec2(pixel_of(camera, place, size)),
                                           glm::dvec2((points->size + 3) * frame.ui.scale)));
            }
    places.placed = place_labels(wishes, size, taken, frame.ui.scale);
    places.hidden.clear();
    for (const PlacedLabel& placed : places.placed) {
        places.hidden.push_back(hidden(pixel_of(camera, scene.labels[placed.wish].place, size)));
        taken.push_back(placed.box);
        if (scene.labels[placed.wish].kind != LabelKind::region)
            taken.push_back(around(wishes[placed.wish].place, glm::dvec2(13 * frame.ui.scale)));
    }
    places.values.clear();
    if (!with_values)
        return;
    const ColourScale& scale = scene.legend->scale;
    places.values = isoline_labels(
        scene.kept ? kept_lines(*scene.isolines, *scene.kept) : *scene.isolines, camera, size,
        [&](double value) {
            const std::string text = tick_text(scale, value);
            return std::pair(text, extent(frame.ui.fonts.small, text));
        },
        hidden, taken, frame.ui.scale);
}

const LabelPlaces& places_of(Frame& frame, View view, const Scene& scene, glm::dvec2 size,
                             const std::vector<PixelBox>& taken)
{
    LabelPlaces& places = frame.ui.labels[size_t(view)];
    const Camera& camera = frame.state.view.camera[size_t(view)];
    const bool moves = std::exchange(places.last_camera, camera) != camera;
    const bool with_values = scene.isolines && scene.legend &&
                             !(moves && frame.state.document.session.part->mesh.triangles() > many_triangles);
    const auto isolines = with_values ? scene.isolines : nullptr;
    const Session& session = frame.state.document.session;
    const bool picker = frame.pickers.ready_picker(session, view) != nullptr;
    if (places.part == session.part && places.picker == picker && places.camera == camera && places.size == size &&
        places.isolines == isolines && places.taken == taken && places.kept == scene.kept &&
        places.labels == scene.labels)
        return places;
    find_places(frame, view, scene, size, with_values, taken, places);
    places.part = session.part;
    places.picker = picker;
    places.camera = camera;
    places.size = size;
    places.isolines = isolines;
    places.taken = taken;
    places.kept = scene.kept;
    places.labels = scene.labels;
    return places;
}

/// From the border of a label to its place.
void leader(ImDrawList* draw, ImVec2 from, const PixelBox& box, glm::dvec2 place, ImU32 colour, ImU32 halo, float scale)
{
    const glm::dvec2 start = glm::clamp(place, box.least, box.greatest);
    const ImVec2 a(from.x + float(start.x), from.y + float(start.y)),
        b(from.x + float(place.x), from.y + float(place.y));
    draw->AddLine(a, b, halo, 3 * scale);
    draw->AddLine(a, b, colour, scale);
}

} // namespace

void haloed(ImDrawList* draw, ImVec2 at, ImU32 colour, ImU32 halo, const char* text)
{
    // as wide for large letters
    const float wide = std::max(1.f, std::round(ImGui::GetFontSize() / 15));
    for (const ImVec2 d : {ImVec2(-1, 0), ImVec2(1, 0), ImVec2(0, -1), ImVec2(0, 1), ImVec2(-1, -1), ImVec2(1, 1),
                           ImVec2(1, -1), ImVec2(-1, 1)})
        draw->AddText({at.x + wide * d.x, at.y + wide * d.y}, halo, text);
    draw->AddText(at, colour, text);
}

void draw_labels(Frame& frame, View view, const Scene& scene, ImVec2 from, ImVec2 size,
                 const std::vector<PixelBox>& taken, ImDrawList* draw)
{
    const glm::dvec2 pixels(size.x, size.y);
    const LabelPlaces& places = places_of(frame, view, scene, pixels, taken);
    const Camera& camera = frame.state.view.camera[size_t(view)];
    const Colour ground = frame.state.view.dark ? Colour{0.08f, 0.09f, 0.12f, 0.82f} : Colour{1, 1, 1, 0.82f};
    const auto at = [&](glm::dvec2 pixel) {
        return ImVec2(std::round(from.x + float(pixel.x)), std::round(from.y + float(pixel.y)));
    };

    ImGui::PushFont(frame.ui.fonts.small);
    for (const IsolineLabel& value : places.values)
        haloed(draw, at(value.box.least), IM_COL32(12, 14, 20, 255), IM_COL32(255, 255, 255, 200), value.text.c_str());
    ImGui::PopFont();
    constexpr float pale = 0.6f;
    for (size_t i = 0; i < places.placed.size(); ++i) {
        const PlacedLabel& placed = places.placed[i];
        const SceneLabel& label = scene.labels[placed.wish];
        const float strength = places.hidden[i] ? pale : 1;
        const ImU32 colour = ink(label.colour, strength), halo = ink(ground, strength);
        if (placed.pushed)
            leader(draw, from, placed.box, glm::dvec2(pixel_of(camera, label.place, pixels)), colour, halo,
                   frame.ui.scale);
        const float pad = 2 * frame.ui.scale;
        const ImVec2 least = at(placed.box.least), greatest = at(placed.box.greatest);
        draw->AddRectFilled({least.x - 2 * pad, least.y - pad}, {greatest.x + 2 * pad, greatest.y + pad}, halo,
                            2 * pad);
        draw->AddText(least, colour, label.text.c_str());
    }
}

} // namespace spia::viewer
