#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spia::viewer {

struct Frame;

/// Chooses a file or a folder by mouse or keyboard: the arrows move in the list, Return takes what
/// is chosen, Escape leaves. In a window of ImGui: on a Debian desktop there is no library for the
/// system's own dialog.
class FileDialog {
public:
    enum class Purpose {
        open_part,
        open_project,
        save_project,
        export_folder,
        save_report,
        save_picture,
        save_animation,
        open_material,
        open_tensile_test,
        save_material,
        open_limit_curve,
        open_k_table,
        open_steps,
        save_steps
    };

    /// @param suggestion file or folder to begin with; may be empty
    void open(Purpose purpose, const std::filesystem::path& suggestion = {});
    bool is_open() const { return open_; }
    Purpose purpose() const { return purpose_; }

    /// Draws it. @returns the choice, in the frame in which it was made
    std::optional<std::filesystem::path> show(const Frame& frame);

private:
    struct Entry {
        std::filesystem::path path;
        bool folder;
        std::uintmax_t size;
    };
    void go_to(const std::filesystem::path& folder);
    void move_cursor(int rows);
    void list(const Frame& frame, float below);
    void new_folder_row(bool enter);
    std::string others_text() const;
    float width_of_others() const; ///< pixels, of what others_row() shows
    void problem_row(const Frame& frame);
    void others_row();
    /// Goes to the folder that is typed, if it is another one. @returns whether there is none or it
    /// could be done
    bool follow_path_text();
    /// What is chosen now: a folder is entered, a file returned if it can be.
    std::optional<std::filesystem::path> take();

    Purpose purpose_ = Purpose::open_part;
    bool open_ = false, appearing_ = false, appearing_name_ = false;
    std::filesystem::path folder_;
    std::string name_, path_text_, problem_;
    std::vector<Entry> entries_;
    bool show_all_ = false;                 ///< files of every kind
    int others_ = 0;                        ///< files in the folder that are of other kinds
    int openings_ = 0;                      ///< so far: no field keeps what was typed the last time
    std::optional<std::string> new_folder_; ///< its name, while it is being typed
    int cursor_ = -1;                       ///< entry that is chosen; -1: what is typed counts
    bool moved_ = false;                    ///< the cursor, by a key: it is to be seen
    bool taken_ = false;                    ///< by Return or a double click
    bool path_active_ = false;              ///< whether the folder is being typed
    bool confirm_ = false;                  ///< the file exists already
};

} // namespace spia::viewer
