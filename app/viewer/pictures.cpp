#include "app/viewer/pictures.h"

#include <algorithm>
#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include "app/viewer/render/offscreen.h"
#include "app/viewer/render/picture_file.h"
#include "app/viewer/views/views.h"
#include "engine/core/error.h"

namespace spia::viewer {
namespace {

/// Another context of ImGui, until its end; then the one before is back.
class AsideContext {
public:
    AsideContext() { ImGui::SetCurrentContext(own_); }
    ~AsideContext()
    {
        ImGui::DestroyContext(own_);
        ImGui::SetCurrentContext(before_);
    }
    AsideContext(const AsideContext&) = delete;
    AsideContext& operator=(const AsideContext&) = delete;

private:
    ImGuiContext* before_ = ImGui::GetCurrentContext();
    ImGuiContext* own_ = ImGui::CreateContext();
};

/// What ImGui needs to draw with OpenGL, in the current context.
struct OpenGlBackend {
    OpenGlBackend()
    {
        if (!ImGui_ImplOpenGL3_Init("#version 330 core"))
            throw Error("legend and labels of a picture cannot be drawn: ImGui finds no OpenGL 3.3; update the "
                        "graphics driver");
    }
    ~OpenGlBackend() { ImGui_ImplOpenGL3_Shutdown(); }
    OpenGlBackend(const OpenGlBackend&) = delete;
    OpenGlBackend& operator=(const OpenGlBackend&) = delete;
};

/// ImGui beside the window's, with letters of its own size.
class PictureGui {
public:
    PictureGui(int width, int height, float scale, bool dark)
    {
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {float(width), float(height)};
        fonts_ = load_fonts(scale);
        apply_theme(dark, scale);
    }
    const Fonts& fonts() const { return fonts_; }

    template <class Draw> void frame(const Draw& draw)
    {
        ImGui_ImplOpenGL3_NewFrame();
        ImGui::NewFrame();
        draw();
        ImGui::Render();
    }

private:
    AsideContext context_;
    OpenGlBackend backend_;
    Fonts fonts_;
};

/// One pixel over another. What ImGui leaves on nothing has its colours multiplied by its opacity.
void blend(const uint8_t* above, uint8_t* below)
{
    const int a = above[3];
    if (a == 0)
        return;
    const int b = below[3] * (255 - a) / 255; // what is still seen of the lower one
    for (int c = 0; c < 3; ++c)
        below[c] = uint8_t(std::min(255, (255 * above[c] + b * below[c]) / (a + b)));
    below[3] = uint8_t(a + b);
}

/// Lays what ImGui has drawn in its last frame over a picture of the same size.
void lay_over(Picture& picture, ImDrawData& drawn)
{
    const int side = std::min(2048, longest_side());
    for (int y = 0; y < picture.height; y += side)
        for (int x = 0; x < picture.width; x += side) {
            const int width = std::min(side, picture.width - x), height = std::min(side, picture.height - y);
            drawn.DisplayPos = {float(x), float(y)};
            drawn.DisplaySize = {float(width), float(height)};
            drawn.FramebufferScale = {1, 1};
            const Offscreen target(width, height, 1);
            target.begin();
            target.clear();
            ImGui_ImplOpenGL3_RenderDrawData(&drawn);
            const std::vector<uint8_t> rows = target.pixels();
            for (int row = 0; row < height; ++row) // OpenGL's rows run upwards
                for (int column = 0; column < width; ++column)
                    blend(&rows[(size_t(height - 1 - row) * size_t(width) + size_t(column)) * 4],
                          &picture.rgba[(size_t(y + row) * size_t(picture.width) + size_t(x + column)) * 4]);
        }
}

/// The whole blank or part, with room for the legend.
Camera fitted(const Camera& camera, const Session& session, View view, glm::dvec2 size, double scale)
{
    const double around = 24 * scale, legend = 72 * scale;
    const Margins margins{around + legend, around, around, around};
    if (view != View::blank)
        return fit(camera, session.part->mesh.position, size, margins);
    Eigen::Matrix3Xd flat = Eigen::Matrix3Xd::Zero(3, session.blank->blank.position.cols());
    flat.topRows(2) = session.blank->blank.position;
    return fit(camera, flat, size, margins);
}

} // namespace

float picture_scale(int width, int height) { return std::max(1.f, std::min(float(width) / 960, float(height) / 640)); }

Picture picture_of_view(Renderer& renderer, ViewerModel& model, const ViewerState& state, SceneCache& cache, View view,
                        int width, int height, const PictureContent& content)
{
    const float scale = content.larger * picture_scale(width, height);
    const Scene shown = scene(view, state, cache, height / scale);
    Look look;
    look.dark = state.view.dark;
    look.content_scale = scale;
    look.ground = content.ground;
    Picture picture = renderer.picture(shown, state.view.camera[size_t(view)], width, height, look);
    if (!content.legend && !content.labels)
        return picture;
    PictureGui gui(width, height, scale, look.dark);
    Ui ui;
    ui.scale = scale;
    ui.fonts = gui.fonts();
    ActionQueue nobody;
    Frame frame{model, {}, model.pickers(), state, nobody, ui, cache, {}, {}, {}};
    gui.frame([&] {
        ImDrawList* const draw = ImGui::GetBackgroundDrawList();
        const ImVec2 size{float(width), float(height)};
        const auto legend = content.legend ? draw_legend(frame, shown, {0, 0}, size, draw) : std::nullopt;
        if (content.labels)
            draw_labels(frame, view, shown, {0, 0}, size, legend ? std::vector{*legend} : std::vector<PixelBox>{},
                        draw);
    });
    lay_over(picture, *ImGui::GetDrawData());
    return picture;
}

Picture picture_of_window(Renderer& renderer, ViewerModel& model, SceneCache& cache, const Ui& ui, glm::ivec2 screen,
                          int width, int height)
{
    Picture picture{width, height, std::vector<uint8_t>(size_t(width) * size_t(height) * 4)};
    const float scale =
        ui.scale * std::max(1.f, std::min(float(width) / float(screen.x), float(height) / float(screen.y)));
    PictureGui gui(width, height, scale, model.state().view.dark);
    ViewerState quiet = model.state();
    quiet.messages.clear(); // they would cover a view
    Ui aside = ui;
    aside.fonts = gui.fonts();
    aside.scale = scale;
    aside.keys.clear();
    aside.aside = true;
    aside.labels = {};
    aside.files = {};
    aside.held.reset();
    aside.left_work.reset();
    aside.sample = false;
    aside.show_export = aside.show_picture = aside.show_report = aside.show_material = aside.materials.appears =
        aside.show_shortcuts = aside.show_preferences = aside.show_about = aside.show_animation = aside.manual.shown =
            false;
    aside.dialogs = {};
    std::array<Renderer::Image, 4> images;
    std::vector<Renderer::Image> steps;
    Renderer::Image beside;
    ActionQueue nobody;
    Look look;
    look.dark = model.state().view.dark;
    look.content_scale = scale;
    constexpr int64_t many = 1 << 24; // pixels: fine enough without samples, and these need memory
    look.samples = int64_t(width) * height > many ? 1 : look.samples;
    Frame frame{model,
                {},
                model.pickers(),
                quiet,
                nobody,
                aside,
                cache,
                [&](const Scene& shown, View view, int w, int h) {
                    const Camera& camera = model.state().view.camera[size_t(view)];
                    return DrawnView{reinterpret_cast<ImTextureID>(
                        uintptr_t(renderer.draw(images[size_t(view)], shown, camera, w, h, look)))};
                },
                [&](const Scene& shown, const Camera& camera, int w, int h) {
                    return reinterpret_cast<ImTextureID>(uintptr_t(renderer.draw(beside, shown, camera, w, h, look)));
                },
                [&](const StepPicture& small, size_t step, int w, int h) {
                    while (steps.size() <= step)
                        steps.emplace_back();
                    return reinterpret_cast<ImTextureID>(
                        uintptr_t(renderer.draw(steps[step], small.scene, small.camera, w, h, look)));
                }};
    constexpr int frames_to_settle = 3; // until windows that fit their content have their size
    for (int k = 0; k < frames_to_settle; ++k)
        gui.frame([&] { workbench(frame); });
    lay_over(picture, *ImGui::GetDrawData());
    for (size_t k = 3; k < picture.rgba.size(); k += 4)
        picture.rgba[k] = 255;
    return picture;
}

std::vector<TitledPicture> report_pictures(Renderer& renderer, ViewerModel& model, SceneCache& cache,
                                           const ViewerReportOptions& options)
{
    constexpr int width = 1200, height = 800;
    // on paper they are small
    constexpr float larger = 1.3f;
    const PictureContent content{.ground = !options.standard_look, .larger = larger}; // white paper
    constexpr const char* standard_titles[] = {"Part: thinning, smooth (each vertex the mean of its faces)",
                                               "Blank: the same, with the corners of the grid",
                                               "Quad mesh on the part: scaled Jacobian of the cells in the plane",
                                               "NURBS surface with its control net: distance from the part"};
    ViewerState shown = options.standard_look ? standard_look(model.state()) : model.state();
    shown.preferences.lengths = options.lengths;
    const Session& session = shown.document.session;
    std::vector<TitledPicture> pictures;
    for (const View view : all_views) {
        if (std::find(options.pictures.begin(), options.pictures.end(), view) == options.pictures.end() ||
            (view == View::blank && !session.blank) || (view == View::quads && !session.lifted) ||
            (view == View::surface && !session.surface))
            continue;
        Camera& camera = shown.view.camera[size_t(view)];
        if (options.standard_look)
            camera = fitted(camera, session, view, {width, height}, larger * picture_scale(width, height));
        pictures.push_back({options.standard_look ? standard_titles[size_t(view)] : title(view),
                            picture_of_view(renderer, model, shown, cache, view, width, height, content)});
    }
    return pictures;
}

std::vector<ReportPicture> png_files(const std::vector<TitledPicture>& pictures)
{
    std::vector<ReportPicture> files;
    for (const TitledPicture& each : pictures)
        files.push_back({each.title, png(each.picture)});
    return files;
}

} // namespace spia::viewer
