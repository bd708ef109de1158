#include <CLI/CLI.hpp>
#include <cstdlib>
#include <fmt/core.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "app/viewer/window.h"
#include "engine/core/error.h"
#include "engine/options/option.h"

int main(int count, char** values)
{
    using namespace spia;
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>("spia", std::make_shared<spdlog::sinks::stderr_sink_mt>()));
    spdlog::set_level(spdlog::level::warn);

    viewer::WindowOptions options;
    options.assets = std::getenv("SPIA_ASSETS") ? std::getenv("SPIA_ASSETS") : SPIA_ASSETS_DIR;
    CLI::App app{
        "SPIA: unfold a stamped part, inspect its strains, export NURBS. Without a part it opens the sample part."};
    app.set_version_flag("--version", SPIA_VERSION);
    app.add_option("part", options.file,
                   "CAD file, solver deck or mesh (spia-viewer opens what spia run reads), or a project (.spia)")
        ->type_name("PART");
    app.add_option("--unit", options.unit, "length unit of the part")->check(CLI::IsMember({"mm", "cm", "m", "inch"}));
    app.add_flag("--run-all", options.run_all, "unfold and fit a surface at once");
    app.add_option("--script", options.script, "replay the actions of a file (see app/viewer/README.md)")
        ->type_name("FILE");
    app.add_option("--report", options.report, "write the state at the end as JSON")->type_name("FILE");
    app.add_flag("--follow", options.follow, "write the report also whenever the window has come to rest")
        ->needs("--report");
    app.add_option("--screenshot", options.screenshot, "write a picture of the window at the end (PNG)")
        ->type_name("FILE");
    app.add_flag("--exit", options.exit, "quit when all this is done");
    app.add_flag("--light", options.light, "begin with the light theme");
    app.add_option("--width", options.width, "of the window, pixels; without it up to 1440, as the screen has room")
        ->check(CLI::Range(320, 16384));
    app.add_option("--height", options.height, "of the window, pixels; without it up to 900")
        ->check(CLI::Range(240, 16384));
    try {
        app.parse(count, values);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (!options.script.empty())
        options.exit = true;
    try {
        return viewer::show_window(options);
    } catch (const InputError& error) {
        fmt::print(stderr, "spia-viewer: {}\n", window_text(error.what()));
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "spia-viewer: {}\n", window_text(error.what()));
        return 5;
    }
}
