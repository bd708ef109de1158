#include "app/viewer/window.h"

#include <epoxy/gl.h>
// after epoxy
#include <GLFW/glfw3.h>
#include <algorithm>
#include <cfloat>
#include <chrono>
#include <fmt/core.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include "app/viewer/gl_window.h"
#include "app/viewer/model/actions/members.h"
#include "app/viewer/model/actions/script_player.h"
#include "app/viewer/model/document/recent_files.h"
#include "app/viewer/model/jobs/frame_times.h"
#include "app/viewer/model/jobs/kept_work.h"
#include "app/viewer/model/reports/state_report.h"
#include "app/viewer/panels/gui_frame.h"
#include "app/viewer/panels/ui.h"
#include "app/viewer/preference_keeper.h"
#include "app/viewer/render/file_textures.h"
#include "app/viewer/render/renderer.h"
#include "app/viewer/render/view_images.h"
#include "app/viewer/versions.h"
#include "app/viewer/view_glide.h"
#include "app/viewer/views/views.h"
#include "app/viewer/window_files.h"
#include "app/viewer/window_report.h"
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"

namespace spia::viewer {
namespace {

using Clock = std::chrono::steady_clock;

class Program {
public:
    explicit Program(const WindowOptions& options)
        : options_(options), window_(options.width, options.height, true), gui_(window_.get()),
          model_(options.assets, [] { glfwPostEmptyEvent(); })
    {
        model_.ask_before_replacing(!options.exit);
        ui_.scale = wanted_scale();
        ui_.fonts = load_fonts(ui_.scale);
        if (!ui_.fonts.missing.empty())
            model_.say(Severity::warning,
                       fmt::format("The font {} is missing (Debian package fonts-inter).", ui_.fonts.missing));
        ui_.recent = recent_files();
        ui_.versions = versions();
        glfwSetWindowUserPointer(window_.get(), this);
        glfwSetDropCallback(window_.get(), [](GLFWwindow* window, int count, const char** paths) {
            for (int k = 0; k < count; ++k)
                static_cast<Program*>(glfwGetWindowUserPointer(window))->open(paths[k], "");
        });
        if (!options.script.empty())
            script_ = ScriptPlayer(parse_script(options.script));
        begin();
    }

    int run()
    {
        int settle = 3;
        while (!quit_) {
            const bool was_moving = moving();
            // What the last frame has left to be drawn or done is no event: nobody would wake the
            // window for it.
            const bool unfinished = GlWindow::news() || images_.any_late() || !ui_.keys_later.empty();
            const bool moves =
                unfinished || !script_.ended() || !queue_.empty() || files_.drawing() || settle > 0 || finishing();
            if (options_.follow && !moves && (ui_.busy || !was_moving))
                write_atomically(options_.report, report().dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
            if (moves)
                glfwPollEvents();
            else if (model_.busy())
                glfwWaitEventsTimeout(0.1);
            else if (was_moving) {
                glfwWaitEventsTimeout(seconds_to_stand_still);
                GlWindow::news() = true;
            } else {
                const double until = ui_.wake_at > 0  ? std::max(0.01, ui_.wake_at - ImGui::GetTime())
                                     : work_to_keep() ? std::max(0.1, kept_.due_in())
                                                      : 60; // work is kept now and then
                glfwWaitEventsTimeout(ImGui::GetIO().WantTextInput ? std::min(0.4, until) : until);
            }
            constexpr int frames_to_settle = 3; // until everything that follows from an event has
                                                // its place
            if (unfinished)
                GlWindow::news() = true;
            settle = std::exchange(GlWindow::news(), false) ? frames_to_settle : std::max(0, settle - 1);
            const size_t actions = actions_done_;
            try {
                frame();
                failed_frames_ = 0;
            } catch (const std::exception& error) {
                frame_failed(error.what());
                settle = frames_to_settle;
                continue;
            }
            next_step();
            if (actions_done_ != actions)
                settle = frames_to_settle;
            if (glfwWindowShouldClose(window_.get())) {
                glfwSetWindowShouldClose(window_.get(), GLFW_FALSE);
                queue_.push(Quit{});
                settle = frames_to_settle;
            }
        }
        files_.wait();
        follow_files();
        if (!options_.report.empty())
            write_atomically(options_.report, report().dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
        if (options_.exit && options_.script.empty() && exit_code_ == 0)
            for (const Message& message : model_.state().messages)
                if (message.severity == Severity::error && !message.dismissed) {
                    fmt::print(stderr, "spia-viewer: {}\n", message.text);
                    exit_code_ = 1;
                }
        kept_.end();
        return exit_code_;
    }

private:
    float wanted_scale() const
    {
        return window_.content_scale() * float(model_.state().preferences.interface_percent) / 100;
    }

    /// Something that no action has caught, say a picture that cannot be drawn: the work is kept
    /// for the next start, and the program goes on unless it happens again and again.
    void frame_failed(std::string text)
    {
        end_broken_frame();
        if (model_.state().document.session.part)
            try {
                kept_.keep(model_.state());
            } catch (const std::exception& error) {
                text += fmt::format("; the work cannot be autosaved: {}", error.what());
            }
        constexpr int most = 3;
        if (++failed_frames_ >= most)
            throw Error(fmt::format("the window could not be drawn {} times in a row: {}", most, text));
        model_.say(
            Severity::error,
            fmt::format(
                "The window could not be drawn: {}. Save the project; if this happens again, restart the program.",
                text));
    }

    void open(const std::filesystem::path& file, const std::string& unit)
    {
        if (file.extension() == project_ending)
            queue_.push(OpenProject{file});
        else if (has_choices(file) && unit.empty() && !options_.exit && !options_.run_all)
            queue_.push(ListFile{file});
        else
            queue_.push(OpenPart{file, unit});
    }

    void begin()
    {
        if (!options_.script.empty() && options_.file.empty())
            return;
        if (!options_.file.empty())
            open(options_.file, options_.unit);
        else {
            queue_.push(OpenPart{options_.assets / "parts" / "inner-panel.obj", ""});
            opening_sample_ = true;
        }
        if (!options_.exit)
            kept_.look_for_left();
        if (options_.run_all)
            queue_.push(RunTo{Stage::fit});
    }

    void follow_answer()
    {
        if (!ui_.left_work || ui_.left_work->answer == LeftWork::Answer::none)
            return;
        const LeftWork::Answer answer = std::exchange(ui_.left_work, std::nullopt)->answer;
        if (answer == LeftWork::Answer::recover)
            queue_.push(kept_.recover());
        else if (answer == LeftWork::Answer::discard)
            kept_.discard();
        else
            kept_.later();
    }

    /// Whether --exit waits for nothing any more, and the last frames are drawn.
    bool finishing() const
    {
        return options_.exit && script_.ended() && !model_.busy() && !files_.busy() && queue_.empty();
    }

    void frame()
    {
        const auto start = Clock::now();
        const bool solving = model_.busy();
        model_.poll();
        if (solving && !model_.busy()) // what it brings may need some frames to find its place
            GlWindow::news() = true;
        follow_files();
        if (glide_.runs()) {
            GlWindow::news() = true;
            glide_.follow(may_glide(), ImGui::GetTime());
        }
        int width = 0, height = 0;
        glfwGetFramebufferSize(window_.get(), &width, &height);
        // on another screen, or preferred
        if (const float scale = wanted_scale(); scale != ui_.scale) {
            ui_.scale = scale;
            ImGui::GetIO().Fonts->Clear();
            ui_.fonts = load_fonts(scale);
            ImGui_ImplOpenGL3_DestroyFontsTexture();
            ImGui_ImplOpenGL3_CreateFontsTexture();
            dark_.reset();
        }
        if (dark_ != model_.state().view.dark) {
            dark_ = model_.state().view.dark;
            apply_theme(*dark_, ui_.scale);
        }
        // The dialog of files has its own keys for its list, a view that has the keyboard as well;
        // Alt leads from it to the menus.
        ImGuiConfigFlags& flags = ImGui::GetIO().ConfigFlags;
        const bool alt = glfwGetKey(window_.get(), GLFW_KEY_LEFT_ALT) == GLFW_PRESS ||
                         glfwGetKey(window_.get(), GLFW_KEY_RIGHT_ALT) == GLFW_PRESS;
        flags = (ui_.focus && !alt) || ui_.files.is_open() ? flags & ~ImGuiConfigFlags_NavEnableKeyboard
                                                           : flags | ImGuiConfigFlags_NavEnableKeyboard;
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        const bool menu_takes_return = take_return_in_menus(), menus = menus_are_open();
        GlWindow::place_mouse();
        window_.call(window_title(model_.state()));
        if (options_.exit) // nobody is there: where the mouse happens to be is not to be seen
            ImGui::GetIO().MousePos = {-FLT_MAX, -FLT_MAX};
        ImGui::NewFrame();
        const bool drawing = images_.any_late();
        images_.begin_frame();
        follow_cameras();
        Frame now{
            model_,
            ViewEvents(model_),
            model_.pickers(),
            model_.state(),
            queue_,
            ui_,
            cache_,
            [&](const Scene& shown, View view, int w, int h) {
                const ViewImages::Drawn drawn = images_.draw(size_t(view), ui_.busy == view, shown,
                                                             model_.state().view.camera[size_t(view)], w, h, look());
                return DrawnView{reinterpret_cast<ImTextureID>(uintptr_t(drawn.texture)), drawn.old};
            },
            [&](const Scene& shown, const Camera& camera, int w, int h) {
                return reinterpret_cast<ImTextureID>(uintptr_t(images_.draw_small(0, shown, camera, w, h, look())));
            },
            [&](const StepPicture& picture, size_t step, int w, int h) {
                return reinterpret_cast<ImTextureID>(
                    uintptr_t(images_.draw_small(1 + step, picture.scene, picture.camera, w, h, look())));
            },
            drawing,
            [&](const std::filesystem::path& file) {
                const FileTextures::Shown shown = textures_.of(file);
                return PictureOnScreen{reinterpret_cast<ImTextureID>(uintptr_t(shown.texture)), shown.width,
                                       shown.height};
            }};
        // One key a frame, in the order in which they were pressed: what a key does is there for
        // the next one. Letters that are typed into a field are ImGui's.
        for (const KeyPress& press : std::exchange(GlWindow::keys(), {})) {
            constexpr int last_printable = 255; // of GLFW's numbers
            const bool typed = ImGui::GetIO().WantTextInput && press.key <= last_printable &&
                               !(press.modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT));
            const bool taken = (menu_takes_return && (press.key == GLFW_KEY_ENTER || press.key == GLFW_KEY_KP_ENTER)) ||
                               (menus && press.key == GLFW_KEY_ESCAPE && (close_menus() || !menus_are_open()));
            if (!typed && !taken)
                ui_.keys_later.push_back(press);
        }
        ui_.keys.clear();
        if (!ui_.keys_later.empty()) {
            ui_.keys.push_back(ui_.keys_later.front());
            ui_.keys_later.erase(ui_.keys_later.begin());
        }
        ui_.path = GlWindow::take_path();
        if (files_.pictures_wait()) // a picture shows what hides its labels, however busy the
                                    // machine is
            model_.pickers().picker(model_.state().document.session, View::part);
        const ViewSettings seen = model_.state().view;
        workbench(now);
        ImGui::Render();
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glViewport(0, 0, width, height);
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        if (options_.follow) {
            on_screen_.texts = texts_on_screen(*ImGui::GetDrawData());
            on_screen_.marked = marked_item();
        }
        // the foot tells of the frame before
        files_.draw(width, height, !drawing && !images_.any_late());
        const double busy = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        times_.all.push_back(busy);
        if (solving)
            times_.solving.push_back(busy);
        if (ui_.busy)
            times_.turning.push_back(busy);
        glfwSwapBuffers(window_.get());
        for (Action& action : queue_.take()) {
            glide_.before(action);
            if (options_.follow)
                on_screen_.pushed.emplace(viewer::name(action));
            // a panel changes what it means to change
            if (auto* settings = action.as<SetViewSettings>()) {
                ViewSettings merged = model_.state().view;
                take_changes(seen, settings->view, merged);
                settings->view = merged;
            }
            carry_out(action);
        }
        glide_.begin(may_glide(), ImGui::GetTime());
        if (!ImGui::IsAnyItemActive() && !ImGui::IsAnyMouseDown())
            model_.gesture_ended();
        follow_part();
        preferences_.follow(model_);
        follow_answer();
    }

    Look look() const
    {
        Look result;
        result.dark = model_.state().view.dark;
        result.content_scale = ui_.scale;
        if (moving()) {
            result.samples = 1;
            result.most_triangles = most_while_moving;
        }
        return result;
    }

    /// Whether views are drawn coarse because they follow the mouse. A graphics card draws them as
    /// they are; a picture to be kept, and what a script looks at, never is coarse.
    bool moving() const
    {
        return software_ && !options_.exit && script_.ended() && !files_.pictures_wait() &&
               (ui_.busy || ImGui::GetTime() < moved_at_ + seconds_to_stand_still);
    }
    void follow_cameras()
    {
        if (const auto& now = model_.state().view.camera; now != cameras_) {
            moved_at_ = ImGui::GetTime();
            cameras_ = now;
        }
    }

    /// Work that is not saved would be lost with the end: that waits for the user's word. What
    /// takes the place of the part is read first, see ViewerModel::ask_before_replacing().
    bool ask_first(const Action& action)
    {
        if (!action.is<Quit>())
            return false;
        const bool confirmed = std::exchange(ui_.confirmed, false);
        if (model_.state().document.unsaved && model_.state().document.session.part && !options_.exit && !confirmed) {
            ui_.held = action;
            return true;
        }
        if (confirmed)
            kept_.forget();
        return false;
    }

    /// Whether a glide would be seen as one: with frames as long as these it would only keep the
    /// user waiting. Scripts and tests have what they ask for at once.
    bool may_glide() const
    {
        constexpr double slow = 60; // milliseconds: a glide of four frames
        return !options_.exit && !options_.follow && script_.ended() && options_.script.empty() &&
               (times_.all.empty() || times_.all.back() < slow);
    }

    void carry_out(const Action& action)
    {
        ++actions_done_;
        try {
            if (ask_first(action))
                return;
            if (action.is<ExportFiles>())
                ui_.sample_exported = true;
            const bool opens = action.is<OpenPart>() || action.is<OpenProject>();
            if (opens)
                sample_next_ = std::exchange(opening_sample_, false);
            if (action.is<Quit>())
                quit_ = true;
            else if (opens && !options_.exit)
                kept_.open(model_, action);
            else if (!files_.take(action))
                model_.apply(action);
            if (action.is<SaveProject>() && !model_.state().document.unsaved) {
                kept_.forget();
                remember(model_.state().project);
            }
        } catch (const std::exception& error) {
            model_.say(Severity::error, error.what());
        }
    }

    bool work_to_keep() const
    {
        return !options_.exit && model_.state().document.unsaved && model_.state().document.session.part;
    }

    /// What has been written meanwhile, and what is to be.
    void follow_files()
    {
        kept_.follow(model_, !options_.exit);
        if (kept_.offer() && !ui_.left_work) {
            ui_.left_work = {kept_.offer()->text, kept_.offer()->saved};
            GlWindow::news() = true;
        }
        if (files_.follow())
            GlWindow::news() = true;
    }

    /// A new part belongs into the list of recent files.
    void follow_part()
    {
        const ViewerState& state = model_.state();
        if (std::exchange(known_document_, model_.documents()) != model_.documents())
            ui_.sample = sample_next_;
        if (state.document.session.part == known_part_)
            return;
        known_part_ = state.document.session.part;
        if (!known_part_)
            return;
        if (!ui_.sample)
            remember(state.project.empty() ? state.document.session.file : state.project);
    }

    void remember(const std::filesystem::path& file)
    {
        if (!options_.script.empty())
            return;
        try {
            remember_recent(file);
            ui_.recent = recent_files();
        } catch (const std::exception& error) {
            model_.say(Severity::hint, error.what());
        }
    }

    /// One step of the script per frame; at its end, what was asked for on the command line.
    void next_step()
    {
        if (!queue_.empty() || files_.busy())
            return;
        if (script_.ended()) {
            if (finishing() && ++idle_frames_ > 4) {
                if (!options_.screenshot.empty()) {
                    files_.later({std::exchange(options_.screenshot, {}), {}, 0, 0});
                    idle_frames_ = 0;
                } else
                    quit_ = true;
            }
            return;
        }
        try {
            const auto action = script_.next(model_.state(), model_.busy(), [this] { return report(); });
            if (action && action->is<SetViewSettings>())
                carry_out(*action); // as a whole, of the state now
            else if (action)
                queue_.push(*action);
        } catch (const ScriptFailed& failure) {
            fail(failure.exit_code, failure.what());
        }
    }

    void fail(int code, const std::string& text)
    {
        fmt::print(stderr, "spia-viewer: {}\n", text);
        exit_code_ = code;
        quit_ = true;
    }

    Json report() const
    {
        Json json = state_report(model_.state());
        json["frames"] = FrameTimes::figures(times_.all);
        json["frames_while_solving"] = FrameTimes::figures(times_.solving);
        json["frames_while_turning"] = FrameTimes::figures(times_.turning);
        json["window"] = window_report(ui_, model_.state().view.maximised, on_screen_);
        return json;
    }

    WindowOptions options_;
    // Of a mesh, while it is turned under software OpenGL, and how long a view stands still before
    // it is drawn fine again: a turn of the wheel is followed by another one within 0.2 s.
    static constexpr int most_while_moving = 60000;
    static constexpr double seconds_to_stand_still = 0.3;

    GlWindow window_;
    ImGuiContextOwner gui_;
    ViewerModel model_;
    PreferenceKeeper preferences_{model_, !options_.script.empty(), options_.light};
    Renderer renderer_;
    bool software_ = renderer_.in_software();
    std::array<Camera, 4> cameras_;
    ViewGlide glide_{model_};
    double moved_at_ = -seconds_to_stand_still; ///< of ImGui's clock: a camera was another one in
                                                ///< the frame before
    ViewImages images_{renderer_};
    FileTextures textures_;
    SceneCache cache_;
    ActionQueue queue_;
    Ui ui_;
    std::optional<bool> dark_;
    ScriptPlayer script_;
    WindowFiles files_{renderer_, model_, cache_, ui_};
    KeptWork kept_{[] { glfwPostEmptyEvent(); }};
    std::shared_ptr<const PartFile> known_part_;
    FrameTimes times_;
    OnScreen on_screen_; ///< with --follow
    size_t actions_done_ = 0;
    int idle_frames_ = 0, failed_frames_ = 0, exit_code_ = 0;
    int known_document_ = 0;
    bool quit_ = false, opening_sample_ = false, sample_next_ = false;
};

} // namespace

int show_window(const WindowOptions& options) { return Program(options).run(); }

} // namespace spia::viewer
