#include "app/viewer/panels/dialogs/file_dialog.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <cstdlib>
#include <fmt/core.h>
#include <imgui.h>
#include <imgui_internal.h> // ClearActiveID
#include <utility>

#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/text_input.h"
#include "app/viewer/panels/widgets.h"
#include "engine/core/text.h"
#include "engine/exchange/part_formats.h"

namespace fs = std::filesystem;

namespace spia::viewer {
namespace {

struct Wording {
    const char *title, *button;
    std::vector<std::string> endings; ///< none: every file
    bool saves, folders;
};

const Wording& wording(FileDialog::Purpose purpose)
{
    using P = FileDialog::Purpose;
    static const Wording part{"Open a part", "Open", part_endings(), false, false};
    static const Wording project{"Open a project", "Open", {".spia"}, false, false};
    static const Wording material{"Choose a material file", "Choose", {".json"}, false, false};
    static const Wording test{"Choose a tensile test", "Choose", {".csv", ".txt", ".tsv", ".dat"}, false, false};
    static const Wording grade{"Save the material", "Save", {".json"}, true, false};
    static const Wording limits{"Choose a forming limit curve", "Choose", {".csv", ".txt"}, false, false};
    static const Wording k_table{
        "Choose a table of K factors", "Choose", {".csv", ".txt", ".tsv", ".dat"}, false, false};
    static const Wording save{"Save the project", "Save", {".spia"}, true, false};
    static const Wording folder{"Choose a folder", "Choose this folder", {}, false, true};
    static const Wording report{"Save the report", "Save", {".html"}, true, false};
    static const Wording steps{"Open the steps", "Open", {".json"}, false, false};
    static const Wording save_steps{"Save the steps", "Save", {".json"}, true, false};
    static const Wording picture{"Save a picture", "Save", {".png"}, true, false};
    static const Wording animation{"Save an animation", "Save", {".gif", ".png"}, true, false};
    switch (purpose) {
    case P::open_part: return part;
    case P::open_project: return project;
    case P::open_material: return material;
    case P::open_tensile_test: return test;
    case P::save_material: return grade;
    case P::open_limit_curve: return limits;
    case P::open_k_table: return k_table;
    case P::save_project: return save;
    case P::export_folder: return folder;
    case P::save_report: return report;
    case P::save_picture: return picture;
    case P::save_animation: return animation;
    case P::open_steps: return steps;
    case P::save_steps: return save_steps;
    }
    return part;
}

std::string size_text(std::uintmax_t bytes)
{
    if (bytes < 1000)
        return fmt::format("{} B", bytes);
    if (bytes < 1000000)
        return fmt::format("{:.0f} kB", double(bytes) / 1e3);
    return fmt::format("{:.1f} MB", double(bytes) / 1e6);
}

/// As typed, with ~ for the home folder.
fs::path typed(const std::string& text)
{
    const char* home = std::getenv("HOME");
    if (home && (text == "~" || text.starts_with("~/")))
        return fs::path(home) / text.substr(std::min<size_t>(2, text.size()));
    return text;
}

/// Pressed, or held so long that it counts again.
bool repeated(const Frame& frame, int key)
{
    return pressed(frame, key) || (ImGui::GetIO().KeysDownDuration[key] > 0 && ImGui::IsKeyPressed(key, true));
}

} // namespace

void FileDialog::open(Purpose purpose, const fs::path& suggestion)
{
    purpose_ = purpose;
    open_ = appearing_ = true;
    confirm_ = show_all_ = path_active_ = appearing_name_ = taken_ = false;
    ++openings_;
    new_folder_.reset();
    problem_.clear();
    std::error_code ignored;
    fs::path folder = suggestion;
    name_.clear();
    if (!suggestion.empty() && !fs::is_directory(suggestion, ignored)) {
        name_ = suggestion.filename().string();
        folder = suggestion.parent_path();
    }
    if (folder.empty() || !fs::is_directory(folder, ignored))
        folder = fs::current_path(ignored);
    go_to(fs::absolute(folder, ignored));
    const auto chosen = std::find_if(entries_.begin(), entries_.end(),
                                     [&](const Entry& e) { return !e.folder && e.path.filename() == name_; });
    cursor_ = chosen == entries_.end() ? -1 : int(chosen - entries_.begin());
    moved_ = cursor_ >= 0;
}

void FileDialog::go_to(const fs::path& folder)
{
    std::error_code failed;
    fs::directory_iterator files(folder, fs::directory_options::skip_permission_denied, failed);
    if (failed) {
        problem_ = fmt::format("{}: {}", folder.string(), failed.message());
        path_text_ = folder_.string(); // where the list still is
        return;
    }
    problem_.clear();
    folder_ = folder.lexically_normal();
    path_text_ = folder_.string();
    entries_.clear();
    others_ = 0;
    cursor_ = -1;
    confirm_ = false;
    const Wording& words = wording(purpose_);
    for (const auto& file : files) {
        const std::string name = file.path().filename().string();
        if (name.starts_with('.'))
            continue;
        std::error_code ignored;
        const bool is_folder = file.is_directory(ignored);
        const std::string ending = lower_case(file.path().extension().string());
        if (!is_folder && words.folders)
            continue;
        if (!is_folder && std::find(words.endings.begin(), words.endings.end(), ending) == words.endings.end()) {
            ++others_;
            if (!show_all_)
                continue;
        }
        const std::uintmax_t size = is_folder ? 0 : file.file_size(ignored);
        // a broken link has no size
        entries_.push_back({file.path(), is_folder, ignored ? 0 : size});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return a.folder != b.folder ? a.folder
                                    : lower_case(a.path.filename().string()) < lower_case(b.path.filename().string());
    });
}

void FileDialog::move_cursor(int rows)
{
    if (entries_.empty())
        return;
    cursor_ = cursor_ < 0 ? (rows > 0 ? 0 : int(entries_.size()) - 1)
                          : std::clamp(cursor_ + rows, 0, int(entries_.size()) - 1);
    moved_ = true;
    confirm_ = false;
    if (!entries_[size_t(cursor_)].folder)
        name_ = entries_[size_t(cursor_)].path.filename().string();
}

void FileDialog::list(const Frame& frame, float below)
{
    const Wording& words = wording(purpose_);
    if (!ImGui::BeginTable("files", 2, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersOuter,
                           {0, -below}))
        return;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("size", ImGuiTableColumnFlags_WidthFixed, 80 * frame.ui.scale);
    for (int k = 0; k < int(entries_.size()); ++k) {
        const Entry& entry = entries_[size_t(k)];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const std::string name = entry.path.filename().string();
        const std::string shown = entry.folder ? name + "/" : name;
        if (ImGui::Selectable(shown.c_str(), cursor_ == k,
                              ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
            cursor_ = k;
            confirm_ = false;
            if (!entry.folder)
                name_ = name;
            taken_ |= ImGui::IsMouseDoubleClicked(0) && (entry.folder || !words.folders);
        }
        if (cursor_ == k && std::exchange(moved_, false))
            ImGui::SetScrollHereY();
        ImGui::TableNextColumn();
        if (!entry.folder)
            ImGui::TextDisabled("%s", size_text(entry.size).c_str());
    }
    ImGui::EndTable();
}

std::optional<fs::path> FileDialog::take()
{
    const Wording& words = wording(purpose_);
    std::error_code ignored;
    const bool folder_chosen = cursor_ >= 0 && entries_[size_t(cursor_)].folder;
    if (words.folders || folder_chosen) {
        const fs::path folder = folder_chosen ? entries_[size_t(cursor_)].path : folder_;
        if (words.folders && !taken_)
            return folder;
        go_to(folder);
        return std::nullopt;
    }
    fs::path path = folder_ / typed(name_);
    if (name_.empty())
        return std::nullopt;
    if (fs::is_directory(path, ignored)) {
        go_to(path);
        if (problem_.empty())
            name_.clear();
        return std::nullopt;
    }
    if (words.saves && std::find(words.endings.begin(), words.endings.end(), lower_case(path.extension().string())) ==
                           words.endings.end())
        path += words.endings[0];
    const bool there = fs::exists(path, ignored);
    if (words.saves && there && !std::exchange(confirm_, true))
        return std::nullopt;
    if (!words.saves && !there) {
        problem_ = fmt::format("There is no file {}", path.filename().string());
        return std::nullopt;
    }
    if (words.saves && !fs::is_directory(path.parent_path(), ignored)) {
        problem_ = fmt::format("There is no folder {}", path.parent_path().filename().string());
        return std::nullopt;
    }
    return path.lexically_normal();
}

bool FileDialog::follow_path_text()
{
    const fs::path wanted = typed(path_text_);
    if (wanted.empty() || wanted == folder_)
        return true;
    const std::string name = name_; // of the file to be saved there
    std::error_code ignored;
    go_to(fs::is_regular_file(wanted, ignored) ? wanted.parent_path() : wanted);
    if (problem_.empty())
        name_ = !wording(purpose_).folders && fs::is_regular_file(wanted, ignored) ? wanted.filename().string() : name;
    return problem_.empty();
}

void FileDialog::new_folder_row(bool enter)
{
    const float create = ImGui::CalcTextSize("Create").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SetNextItemWidth(-create - ImGui::GetStyle().ItemSpacing.x);
    if (new_folder_->empty() && !ImGui::IsAnyItemActive())
        ImGui::SetKeyboardFocusHere();
    text_input("##newfolder", *new_folder_, false, "Name of the new folder");
    ImGui::SameLine();
    ImGui::BeginDisabled(new_folder_->empty());
    const bool pressed = ImGui::Button("Create");
    ImGui::EndDisabled();
    if (new_folder_->empty() || !(pressed || enter))
        return;
    if (!follow_path_text())
        return;
    const fs::path folder = folder_ / *new_folder_;
    std::error_code failed;
    fs::create_directory(folder, failed);
    new_folder_.reset();
    if (failed)
        problem_ = fmt::format("{} cannot be created: {}", folder.string(), failed.message());
    else {
        go_to(folder);
        appearing_name_ = true;
    }
}

/// Says how many files are left out, and lets show them; at the right, in the row that says what
/// there is.
std::string FileDialog::others_text() const
{
    return show_all_ ? "All files" : fmt::format("{} other file{} not shown", others_, others_ == 1 ? " is" : "s are");
}

float FileDialog::width_of_others() const
{
    if (others_ == 0)
        return 0;
    const float box = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
    return ImGui::CalcTextSize("Show all files").x + box + ImGui::CalcTextSize(others_text().c_str()).x +
           2 * ImGui::GetStyle().ItemSpacing.x;
}

void FileDialog::problem_row(const Frame& frame)
{
    const float room = ImGui::GetContentRegionAvail().x - width_of_others() - ImGui::GetStyle().ItemSpacing.x;
    const std::string shown = without_middle(problem_, room);
    ImGui::TextColored(palette_of(frame.state.view.dark).error, "%s", shown.c_str());
    if (shown != problem_)
        tooltip(problem_);
}

void FileDialog::others_row()
{
    if (others_ == 0)
        return;
    const std::string text = others_text();
    const float width = width_of_others();
    ImGui::SameLine(std::max(ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + ImGui::GetStyle().ItemSpacing.x,
                             ImGui::GetWindowContentRegionMax().x - width));
    ImGui::TextDisabled("%s", text.c_str());
    ImGui::SameLine();
    if (ImGui::Checkbox("Show all files", &show_all_)) {
        const std::string name = name_, problem = problem_;
        go_to(folder_);
        name_ = name;
        if (problem_.empty())
            problem_ = problem;
        appearing_name_ = true; // typing goes on there
    }
}

std::optional<fs::path> FileDialog::show(const Frame& frame)
{
    if (!open_)
        return std::nullopt;
    const Wording& words = wording(purpose_);
    const float scale = frame.ui.scale;
    const bool appears = std::exchange(appearing_, false);
    bool focus_name = appears;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize({std::min(640 * scale, screen.x - 40), std::min(480 * scale, screen.y - 40)},
                             ImGuiCond_Always);
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    bool stay = true;
    const std::string title = std::string(words.title) + "###choose a file";
    if (!begin_modal(frame, title.c_str(), appears, ImGuiWindowFlags_NoResize, &stay)) {
        open_ = frame.ui.dialogs.wants(title); // it waits behind another one
        appearing_ = appears && open_;         // and takes the keyboard when it comes
        return std::nullopt;
    }
    ImGui::PushID(openings_);
    taken_ = false;
    const bool enter = enter_pressed(frame);
    if (!path_active_) {
        constexpr int page = 10;
        const int rows = (repeated(frame, GLFW_KEY_DOWN) ? 1 : 0) - (repeated(frame, GLFW_KEY_UP) ? 1 : 0) +
                         (repeated(frame, GLFW_KEY_PAGE_DOWN) ? page : 0) -
                         (repeated(frame, GLFW_KEY_PAGE_UP) ? page : 0);
        if (rows != 0) {
            ImGui::ClearActiveID(); // or the line goes on showing what was typed
            move_cursor(rows);
            focus_name = true;
        }
        taken_ |= enter && !new_folder_;
    }
    if (ImGui::ArrowButton("up", ImGuiDir_Up))
        go_to(folder_.parent_path());
    tooltip("To the folder above");
    ImGui::SameLine();
    const bool makes_folders = words.saves || words.folders;
    const float button_width = ImGui::CalcTextSize("New folder").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SetNextItemWidth(makes_folders ? -button_width - ImGui::GetStyle().ItemSpacing.x : -1);
    text_input("##path", path_text_);
    if (std::exchange(path_active_, ImGui::IsItemActive()) && enter) {
        follow_path_text();
        appearing_name_ = true; // typing goes on there
    }
    if (makes_folders) {
        ImGui::SameLine();
        if (ImGui::Button("New folder"))
            new_folder_ = "";
    }
    const bool names_folder = new_folder_.has_value();
    if (names_folder)
        new_folder_row(enter);

    const float gap = ImGui::GetStyle().ItemSpacing.y;
    list(frame, ImGui::GetFrameHeightWithSpacing() + (words.folders ? 0 : ImGui::GetFrameHeightWithSpacing()) +
                    answer_buttons_height(frame) + gap);
    ImGui::AlignTextToFramePadding();
    if (!problem_.empty())
        problem_row(frame);
    else if (confirm_)
        ImGui::TextColored(palette_of(frame.state.view.dark).warning, "This file exists already.");
    else if (entries_.empty())
        ImGui::TextDisabled(words.folders ? "No subfolders here; this folder can be chosen"
                            : words.saves ? "No files of this kind here yet"
                                          : "No files of this kind here");
    else {
        const auto files = std::count_if(entries_.begin(), entries_.end(), [](const Entry& e) { return !e.folder; });
        ImGui::TextDisabled("%d %s", int(files), files == 1 ? "file" : "files");
    }
    others_row();
    if (!words.folders) {
        ImGui::SetNextItemWidth(-1);
        if (focus_name || std::exchange(appearing_name_, false))
            ImGui::SetKeyboardFocusHere();
        if (text_input("##name", name_, false, "File name")) {
            confirm_ = false;
            cursor_ = -1;
            problem_.clear();
        }
    }
    const bool folder_chosen = cursor_ >= 0 && entries_[size_t(cursor_)].folder;
    const std::string label = confirm_                         ? "Replace the file"
                              : words.folders && folder_chosen ? "Choose the selected folder"
                              : folder_chosen                  ? "Open the folder"
                                                               : words.button;
    const Palette p = palette_of(frame.state.view.dark);
    const Answer answer = answer_buttons(frame, label.c_str(), words.folders || folder_chosen || !name_.empty(),
                                         confirm_ ? p.warning : p.accent);
    const bool button = answer == Answer::yes;
    if (answer == Answer::cancel) {
        stay = names_folder; // Escape leaves the name of the folder first
        new_folder_.reset();
    }
    std::optional<fs::path> chosen;
    if (stay && (button || taken_) && follow_path_text()) {
        taken_ &= folder_chosen; // Return and a double click enter a folder, the button takes it
        chosen = take();
        appearing_name_ = !chosen; // in a folder, or after what was not found
    }
    if (chosen || !stay) {
        open_ = false;
        ImGui::CloseCurrentPopup();
    }
    ImGui::PopID();
    ImGui::EndPopup();
    return chosen;
}

} // namespace spia::viewer
