#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spia::viewer {

/// Chooses a file or a folder, in a window of ImGui: on a Debian desktop there is no library for the system's own dialog.
class FileDialog {
public:
    enum class Purpose {
        open_part,
        open_project,
        save_project,
        export_folder,
        save_report,
        save_picture,
        open_material
    };

    /// @param suggestion file or folder to begin with; may be empty
    void open(Purpose purpose, const std::filesystem::path& suggestion = {});
    bool is_open() const { return open_; }
    Purpose purpose() const { return purpose_; }

    /// Draws it. @returns the choice, in the frame in which it was made
    std::optional<std::filesystem::path> show(float scale);

private:
    struct Entry {
        std::filesystem::path path;
        bool folder;
        std::uintmax_t size;
    };
    void go_to(const std::filesystem::path& folder);

    Purpose purpose_ = Purpose::open_part;
    bool open_ = false, appearing_ = false;
    std::filesystem::path folder_;
    std::string name_, path_text_, problem_;
    std::vector<Entry> entries_;
    bool confirm_ = false; ///< the file exists already
};

} // namespace spia::viewer
