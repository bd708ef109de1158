#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/json_file.h"

/// The program itself, run by a test in a folder of its own.
namespace spia::viewer {

/// An empty folder for this test, with a link to the assets, so that scripts find
/// "assets/parts/..." from there.
std::filesystem::path scratch_folder(const std::string& name);

std::string content(const std::filesystem::path& file); ///< its bytes; none if there is no such
                                                        ///< file

struct Ended {
    int exit_code = -1;
    Json report;        ///< null if none was written
    std::string errors; ///< what it wrote to stderr
};

/// Runs the viewer in a folder to its end; with --report and --exit. @param arguments  beside these
Ended run_viewer(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// A viewer that stays open, with xdotool for its hands. Whatever is done to it, wait() tells what
/// came of it: the program writes its report whenever its window has come to rest.
class OpenViewer {
public:
    OpenViewer(std::filesystem::path folder, const std::vector<std::string>& arguments);
    ~OpenViewer(); ///< ends it by force if it still runs
    OpenViewer(const OpenViewer&) = delete;
    OpenViewer& operator=(const OpenViewer&) = delete;

    /// Until the report fulfils a condition. @throws Error after `longest`, with what was awaited
    Json wait(const std::string& what, const std::function<bool(const Json&)>& fulfilled,
              std::chrono::seconds longest = std::chrono::seconds(60));
    Json report() const; ///< the newest; null if there is none yet

    void keys(const std::string& combination); ///< as xdotool names them, e.g. "ctrl+z"
    void type(const std::string& text);        ///< letter by letter
    void rest() const;                         ///< a moment, in which the window draws what a key
                                               ///< did
    void hold(const std::string& key);         ///< until let_go()
    void let_go(const std::string& key);
    Json move(double x, double y); ///< of the window; waits until the program has seen it there
    /// Presses the left button, moves and lets go, all faster than a frame.
    void fling(double x, double y, double to_x, double to_y);
    Json press(int button); ///< 1 left, 2 middle, 3 right; waits until it is seen
    Json release(int button);
    Json click(double x, double y);
    void double_click(int between); ///< milliseconds between the clicks
    Json drag(double from_x, double from_y, double to_x, double to_y, int button = 1);
    void wheel(int notches); ///< above 0 towards the part
    void resize(int width, int height);
    int wait_for_end(); ///< @returns exit code
    /// it is ended without a chance to do anything
    void crash();
    std::string title() const;                                   ///< of the window
    unsigned long window() const { return std::stoul(window_); } ///< of X

private:
    void xdotool(const std::string& arguments) const;
    void note_pushed() const;
    Json button_is(int button, bool down);
    int process_ = -1;
    std::filesystem::path folder_;
    std::string window_;
};

} // namespace spia::viewer
