#include "app/viewer/panels/file_dialog.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/core.h>
#include <imgui.h>
#include <utility>

#include "app/viewer/panels/text_input.h"

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
    static const Wording part{"Open a part", "Open", {".stl", ".obj", ".ply", ".off", ".gltf", ".glb"}, false, false};
    static const Wording project{"Open a project", "Open", {".spia"}, false, false};
    static const Wording material{"Choose a material file", "Choose", {".json"}, false, false};
    static const Wording save{"Save the project", "Save", {".spia"}, true, false};
    static const Wording folder{"Choose a folder", "Choose this folder", {}, false, true};
    static const Wording report{"Save the report", "Save", {".html"}, true, false};
    static const Wording picture{"Save a picture", "Save", {".png"}, true, false};
    switch (purpose) {
    case P::open_part: return part;
    case P::open_project: return project;
    case P::open_material: return material;
    case P::save_project: return save;
    case P::export_folder: return folder;
    case P::save_report: return report;
    case P::save_picture: return picture;
    }
    return part;
}

std::string lower(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

std::string size_text(std::uintmax_t bytes)
{
    if (bytes < 1000)
        return fmt::format("{} B", bytes);
    if (bytes < 1000000)
        return fmt::format("{:.0f} kB", double(bytes) / 1e3);
    return fmt::format("{:.1f} MB", double(bytes) / 1e6);
}

} // namespace

void FileDialog::open(Purpose purpose, const fs::path& suggestion)
{
    purpose_ = purpose;
    open_ = appearing_ = true;
    confirm_ = false;
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
}

void FileDialog::go_to(const fs::path& folder)
{
    std::error_code failed;
    fs::directory_iterator files(folder, fs::directory_options::skip_permission_denied, failed);
    if (failed) {
        problem_ = fmt::format("{}: {}", folder.string(), failed.message());
        return;
    }
    problem_.clear();
    folder_ = folder.lexically_normal();
    path_text_ = folder_.string();
    entries_.clear();
    const Wording& words = wording(purpose_);
    for (const auto& file : files) {
        const std::string name = file.path().filename().string();
        if (name.starts_with('.'))
            continue;
        std::error_code ignored;
        const bool is_folder = file.is_directory(ignored);
        const std::string ending = lower(file.path().extension().string());
        if (!is_folder &&
            (words.folders || std::find(words.endings.begin(), words.endings.end(), ending) == words.endings.end()))
            continue;
        entries_.push_back({file.path(), is_folder, is_folder ? 0 : file.file_size(ignored)});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return a.folder != b.folder ? a.folder : lower(a.path.filename().string()) < lower(b.path.filename().string());
    });
}

std::optional<fs::path> FileDialog::show(float scale)
{
    if (!open_)
        return std::nullopt;
    const Wording& words = wording(purpose_);
    const bool first = std::exchange(appearing_, false);
    if (first)
        ImGui::OpenPopup(words.title);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize({std::min(640 * scale, screen.x - 40), std::min(480 * scale, screen.y - 40)},
                             ImGuiCond_Always);
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    bool stay = true;
    std::optional<fs::path> chosen;
    if (!ImGui::BeginPopupModal(words.title, &stay, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove)) {
        open_ = false;
        return std::nullopt;
    }
    if (ImGui::ArrowButton("up", ImGuiDir_Up))
        go_to(folder_.parent_path());
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("To the folder above");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    if (text_input("##path", path_text_, true))
        go_to(path_text_);

    const float below =
        ImGui::GetFrameHeightWithSpacing() * (words.folders ? 1 : 2) + ImGui::GetTextLineHeightWithSpacing();
    std::optional<fs::path> enter;
    if (ImGui::BeginTable("files", 2, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersOuter,
                          {0, -below})) {
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("size", ImGuiTableColumnFlags_WidthFixed, 80 * scale);
        for (const Entry& entry : entries_) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            const std::string name = entry.path.filename().string();
            const std::string shown = entry.folder ? name + "/" : name;
            if (ImGui::Selectable(shown.c_str(), !entry.folder && name == name_,
                                  ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
                if (entry.folder)
                    enter = entry.path;
                else {
                    name_ = name;
                    confirm_ = false;
                    if (ImGui::IsMouseDoubleClicked(0) && !words.saves)
                        chosen = entry.path;
                }
            }
            ImGui::TableNextColumn();
            if (!entry.folder)
                ImGui::TextDisabled("%s", size_text(entry.size).c_str());
        }
        ImGui::EndTable();
    }
    if (entries_.empty() && problem_.empty())
        ImGui::TextDisabled("Nothing here to choose%s", words.folders ? "; you may take this folder" : "");
    else if (!problem_.empty())
        ImGui::TextColored({0.95f, 0.45f, 0.4f, 1}, "%s", problem_.c_str());
    else
        ImGui::TextDisabled(
            "%d files", int(std::count_if(entries_.begin(), entries_.end(), [](const Entry& e) { return !e.folder; })));
    if (!words.folders) {
        ImGui::SetNextItemWidth(-1);
        if (first)
            ImGui::SetKeyboardFocusHere();
        if (text_input("##name", name_, false, "File name"))
            confirm_ = false;
    }
    const std::string label = confirm_ ? "Replace the file" : words.button;
    const bool ready = words.folders || !name_.empty();
    ImGui::BeginDisabled(!ready);
    if (ImGui::Button(label.c_str())) {
        fs::path path = words.folders ? folder_ : folder_ / name_;
        if (words.saves && lower(path.extension().string()) != words.endings[0])
            path += words.endings[0];
        std::error_code ignored;
        if (words.saves && !confirm_ && fs::exists(path, ignored))
            confirm_ = true;
        else
            chosen = path;
    }
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)))
        stay = false;
    if (enter)
        go_to(*enter);
    if (chosen || !stay) {
        open_ = false;
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
    return chosen;
}

} // namespace spia::viewer
