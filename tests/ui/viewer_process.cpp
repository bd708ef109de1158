#include "tests/ui/viewer_process.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "engine/core/error.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char *report_file = "report.json", *errors_file = "errors.txt";

void breathe() { std::this_thread::sleep_for(std::chrono::milliseconds(10)); }

/// Parts begin with one patch, whose grid and corners most tests are about.
void prefer_one_patch(const fs::path& folder)
{
    const fs::path file = folder / "config" / "spia" / "preferences.json";
    if (fs::exists(file))
        return;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << R"({"schema": "spia-preferences/1", "one_patch": true})";
}

int start(const fs::path& folder, std::vector<std::string> arguments)
{
    prefer_one_patch(folder);
    fs::remove(folder / report_file); // of a run before
    arguments.insert(arguments.begin(), SPIA_VIEWER);
    arguments.insert(arguments.end(), {"--report", report_file});
    std::vector<char*> values;
    for (std::string& each : arguments)
        values.push_back(each.data());
    values.push_back(nullptr);
    const int process = fork();
    if (process < 0)
        throw Error("no new process can be started");
    if (process > 0)
        return process;
    const int errors = open((folder / errors_file).c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644);
    if (errors < 0 || dup2(errors, STDERR_FILENO) < 0 || chdir(folder.c_str()) != 0)
        _exit(126);
    setenv("XDG_CONFIG_HOME", (folder / "config").c_str(), 1);
    setenv("XDG_STATE_HOME", (folder / "state").c_str(), 1);
    execv(SPIA_VIEWER, values.data());
    _exit(127);
}

int exit_code(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

Json report_in(const fs::path& folder)
{
    const fs::path file = folder / report_file;
    return fs::exists(file) ? read_json(file) : Json(nullptr);
}

/// What a command prints, without the line's end; empty if it fails.
std::string answer_of(const std::string& command)
{
    std::string text;
    FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
    if (!pipe)
        throw Error("no new process can be started");
    for (int c = 0; (c = fgetc(pipe)) != EOF;)
        text += char(c);
    const int status = pclose(pipe);
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    return status == 0 ? text : std::string();
}

} // namespace

std::string content(const fs::path& file)
{
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

fs::path scratch_folder(const std::string& name)
{
    const fs::path folder = fs::current_path() / "ui" / name;
    fs::remove_all(folder);
    fs::create_directories(folder);
    fs::create_directory_symlink(fs::path(SPIA_SOURCE_DIR) / "assets", folder / "assets");
    return folder;
}

Ended run_viewer(const fs::path& folder, const std::vector<std::string>& arguments)
{
    std::vector<std::string> all = arguments;
    all.push_back("--exit");
    int status = 0;
    waitpid(start(folder, all), &status, 0);
    return {exit_code(status), report_in(folder), content(folder / errors_file)};
}

OpenViewer::OpenViewer(fs::path folder, const std::vector<std::string>& arguments) : folder_(std::move(folder))
{
    if (answer_of("xdotool version").empty())
        throw Error("xdotool is missing, which moves the mouse in this test: install the Debian package xdotool");
    std::vector<std::string> all = arguments;
    all.push_back("--follow");
    process_ = start(folder_, all);
    wait("the window", [](const Json&) { return true; });
    window_ = answer_of(fmt::format("xdotool search --onlyvisible --pid {} --name SPIA", process_));
    if (window_.empty() || window_.find('\n') != std::string::npos)
        throw Error(fmt::format("xdotool finds not one window of the viewer but: \"{}\"", window_));
    xdotool(fmt::format("windowfocus --sync {}", window_)); // nobody else does without a window
                                                            // manager
}

OpenViewer::~OpenViewer() { crash(); }

std::string OpenViewer::title() const { return answer_of("xdotool getwindowname " + window_); }

/// Which actions this test has pushed through the window: tests/structure/pushed_by_hand.sh looks
/// whether any is missing.
void OpenViewer::note_pushed() const
{
    const Json now = report();
    if (now.is_null() || !now["window"].contains("pushed"))
        return;
    const fs::path folder = fs::current_path() / "ui" / "pushed";
    fs::create_directories(folder);
    std::string name = "test";
    if (const auto* test = testing::UnitTest::GetInstance()->current_test_info())
        name = std::string(test->test_suite_name()) + "." + test->name();
    std::replace(name.begin(), name.end(), '/', '-');
    std::ofstream file(folder / (name + ".txt"), std::ios::app);
    for (const Json& action : now["window"]["pushed"])
        file << action.get<std::string>() << '\n';
}

void OpenViewer::crash()
{
    if (process_ > 0)
        note_pushed();
    if (process_ > 0) {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    process_ = -1;
}

Json OpenViewer::report() const { return report_in(folder_); }

Json OpenViewer::wait(const std::string& what, const std::function<bool(const Json&)>& fulfilled,
                      std::chrono::seconds longest)
{
    const auto until = Clock::now() + longest;
    while (Clock::now() < until) {
        if (const Json now = report(); !now.is_null() && fulfilled(now))
            return now;
        int status = 0;
        if (waitpid(process_, &status, WNOHANG) == process_) {
            process_ = -1;
            throw Error(fmt::format("the viewer ended with {} before this: {}; {}", exit_code(status), what,
                                    content(folder_ / errors_file)));
        }
        breathe();
    }
    const Json last = report();
    throw Error(fmt::format("not within {} s: {}; the mouse at {}, the job {}, last to undo {}, the messages {}",
                            longest.count(), what, last["window"]["mouse"].dump(), last["job"].dump(),
                            last["history"].dump(), last["messages"].dump()));
}

void OpenViewer::xdotool(const std::string& arguments) const
{
    if (std::system(("xdotool " + arguments).c_str()) != 0)
        throw Error("this fails: xdotool " + arguments);
}

void OpenViewer::keys(const std::string& combination) { xdotool("key " + combination); }

void OpenViewer::type(const std::string& text)
{
    std::string quoted; // for the shell
    for (const char c : text)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    xdotool("type --delay 5 -- '" + quoted + "'");
}

void OpenViewer::rest() const { std::this_thread::sleep_for(std::chrono::milliseconds(100)); }

void OpenViewer::hold(const std::string& key) { xdotool("keydown " + key); }
void OpenViewer::let_go(const std::string& key) { xdotool("keyup " + key); }

Json OpenViewer::move(double x, double y)
{
    const Json place = {std::round(x), std::round(y)};
    xdotool(fmt::format("mousemove --window {} {} {}", window_, std::round(x), std::round(y)));
    return wait(fmt::format("the mouse at {}", place.dump()),
                [&](const Json& now) { return now["window"]["mouse"] == place; });
}

Json OpenViewer::button_is(int button, bool down)
{
    constexpr size_t of_report[] = {0, 0, 2, 1};
    xdotool(fmt::format("{} {}", down ? "mousedown" : "mouseup", button));
    return wait(fmt::format("mouse button {} {}", button, down ? "down" : "up"),
                [&](const Json& now) { return now["window"]["buttons"][of_report[button]] == down; });
}

void OpenViewer::fling(double x, double y, double to_x, double to_y)
{
    xdotool(fmt::format("mousemove --window {0} {1} {2} mousedown 1 mousemove --window {0} {3} {4} mouseup 1", window_,
                        std::round(x), std::round(y), std::round(to_x), std::round(to_y)));
}

Json OpenViewer::press(int button) { return button_is(button, true); }
Json OpenViewer::release(int button) { return button_is(button, false); }

Json OpenViewer::click(double x, double y)
{
    move(x, y);
    press(1);
    return release(1);
}

void OpenViewer::double_click(int between) { xdotool(fmt::format("click --repeat 2 --delay {} 1", between)); }

Json OpenViewer::drag(double from_x, double from_y, double to_x, double to_y, int button)
{
    move(from_x, from_y);
    press(button);
    for (const double share : {0.3, 0.7, 1.})
        move(from_x + share * (to_x - from_x), from_y + share * (to_y - from_y));
    return release(button);
}

void OpenViewer::wheel(int notches)
{
    for (int k = 0; k < std::abs(notches); ++k)
        xdotool(fmt::format("click {}", notches > 0 ? 4 : 5));
}

void OpenViewer::resize(int width, int height) { xdotool(fmt::format("windowsize {} {} {}", window_, width, height)); }

int OpenViewer::wait_for_end()
{
    const auto until = Clock::now() + std::chrono::seconds(30);
    int status = 0;
    while (waitpid(process_, &status, WNOHANG) != process_) {
        if (Clock::now() > until)
            throw Error("the viewer did not end within 30 s");
        breathe();
    }
    process_ = -1;
    note_pushed();
    return exit_code(status);
}

} // namespace spia::viewer
