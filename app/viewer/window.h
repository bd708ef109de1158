#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace spia::viewer {

struct WindowOptions {
    std::filesystem::path file;       ///< part or project; empty: the sample part
    std::string unit;                 ///< of the part; empty: as its format has it
    bool run_all = false;             ///< run the chain at once
    std::filesystem::path script;     ///< replay these steps
    std::filesystem::path report;     ///< write the state here at the end
    bool follow = false;              ///< and whenever the window has come to rest
    std::filesystem::path screenshot; ///< picture of the window at the end
    bool exit = false;                ///< quit when the chain or the script has ended
    int width = 0, height = 0;        ///< of the window, pixels; 0: what the screen has room for
    bool light = false;
    std::filesystem::path assets;
};

/// Shows the window until it is closed. @returns exit code: 0; 1 if an expectation of the script
/// does not hold, or with `exit` and no script an error was said (a part that is refused, a stage
/// without a result); 2 if the script is at fault
/// @throws Error if there is no display or no OpenGL 3.3
int show_window(const WindowOptions& options);

} // namespace spia::viewer
