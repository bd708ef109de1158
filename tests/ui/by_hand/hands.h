#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "tests/ui/viewer_process.h"

namespace spia::viewer {

/// A person at the window: reads what is written on the screen, moves the mouse and presses keys,
/// and loses patience after ten seconds. Nothing else tells the program what to do.
class Hands {
public:
    static constexpr std::chrono::seconds waiting_limit{10};

    /// @param arguments  what the program is started with; none from a desktop's menu
    explicit Hands(const std::filesystem::path& folder, const std::vector<std::string>& arguments = {});

    /// Until a line of text on the screen is this one. @returns the report then
    Json see(const std::string& line);
    Json see_part_of_line(const std::string& part);
    /// Until no line is, nor has it as its part.
    void see_no(const std::string& part);
    bool sees_now(const std::string& line) const;
    bool sees_chosen(const std::string& line) const; ///< in a list, and again in the field below it
    bool sees_marked(const std::string& line) const; ///< by the frame around what the keyboard is
                                                     ///< at
    /// Until what the program says of itself fulfils a condition.
    Json see_that(const std::string& what, const std::function<bool(const Json&)>& fulfilled);
    Json see_ready(); ///< no job, nothing that is still to be drawn

    void click(const std::string& line, double x = 0.5,
               double y = 0.5);               ///< where it stands still; by shares of its size
    void rest_on(const std::string& line);    ///< with the mouse, where it stands still
    void click_part(const std::string& part); ///< on a line that has this as its part
    void double_click(const std::string& line);
    /// Turns the wheel over a place of the window until the line shows, or one that has this as its
    /// part. @returns the report then
    Json scroll_to(const std::string& line, double x, double y, bool whole = true);
    /// pixels from the middle of a line
    void click_beside(const std::string& line, double dx, double dy);
    void click_at(double x, double y);
    void tool(const std::string& name); ///< in the bar, whether its name is written there or not
    /// where the entry is to be seen
    void open_menu(const std::string& title, const std::string& entry);
    void menu(const std::string& title, const std::string& entry);
    void menu(const std::string& title, const std::string& entry, const std::string& under);
    /// By Alt and the arrows, Return takes. @param under an entry of the menu that opens beside;
    /// empty: none does
    void menu_by_keys(const std::string& title, const std::string& entry, const std::string& under = "");
    void keys(const std::string& combination);
    void type(const std::string& text); ///< into what has the keyboard
    void size(int width, int height);

    OpenViewer& viewer() { return viewer_; }
    double longest_wait() const { return longest_; } ///< seconds

private:
    void rest_on(const std::string& words, bool whole, double x, double y);
    void click_on(const std::string& words, bool whole, double x, double y);
    Json waited(const std::string& what, const std::function<bool(const Json&)>& fulfilled);

    OpenViewer viewer_;
    double longest_ = 0;
};

/// Whether blank, grid and surface are computed from what is set, and nothing runs.
inline bool all_fresh(const Json& now)
{
    return now["job"]["running"] == false && now["stages"]["solve"] == true && now["stages"]["grid"] == true &&
           now["stages"]["fit"] == true;
}

} // namespace spia::viewer
