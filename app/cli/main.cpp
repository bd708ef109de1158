#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <optional>

#include "app/cli/subcommand.h"
#include "app/cli/terminal.h"
#include "engine/core/error.h"

namespace {

using namespace spia;

std::function<int()> add_material(CLI::App& command)
{
    command.require_subcommand(1);
    return cli::with_arguments<cli::FitArguments, cli::fit_material>(*command.add_subcommand(
        "fit", "Fit the hardening laws to a tensile test: a text file of two columns, strain and stress in MPa"));
}

constexpr cli::Subcommand subcommands[] = {
    {"run", "Unfold a part and write blank, strains and surface", true,
     cli::with_arguments<cli::RunArguments, cli::run>},
    {"info", "Examine a part: what it is, what is wrong with it, what to do", false,
     cli::with_arguments<cli::InfoArguments, cli::info>},
    {"compare", "Unfold a part by this solver, ABF++, ARAP, LSCM and SLIM; compare time, memory and distortion", true,
     cli::with_arguments<cli::CompareArguments, cli::compare>},
    {"unfold", "Unfold a part step by step: outer flanges first, each onto the face of its neighbour", true,
     cli::with_arguments<cli::UnfoldArguments, cli::unfold>},
    {"materials", "List the built-in sheet grades", false,
     [](CLI::App&) -> std::function<int()> { return cli::materials; }},
    {"material", "Make a material file", false, add_material}};

/// The words of the command line. The number behind --weld may be left out, which CLI11 would take
/// the next word for.
std::vector<std::string> arguments_of(int count, char** values)
{
    std::vector<std::string> words;
    for (int i = 1; i < count; ++i) {
        words.emplace_back(values[i]);
        double number = 0;
        if (words.back() != "--weld")
            continue;
        if (i + 1 < count && CLI::detail::lexical_cast(std::string(values[i + 1]), number))
            words.back() += fmt::format("={}", values[++i]);
        else
            words.back() += "=0";
    }
    return words;
}

enum ExitCode { fine = 0, poorer = 1, bad_input = 2, no_solution = 3, bad_file = 4, internal = 5, cancelled = 130 };

int failed(ExitCode code, std::string_view what)
{
    fmt::print(stderr, "spia: {}\n", spia::cli::shown(what));
    return code;
}

/// Complains of a word that is empty, as of a variable that a script did not set: the parser would
/// take it for an option that was not given. Empty: there is none.
std::string empty_word(int count, char** values)
{
    for (int i = 1; i < count; ++i)
        if (const std::string_view word = values[i]; word.empty() || (word.starts_with("--") && word.ends_with('=')))
            return word.empty() ? fmt::format("the word after '{}' is empty", values[i - 1])
                                : fmt::format("'{}' needs a value", word);
    return "";
}

/// @returns the exit code
int done(const std::function<int()>& run)
{
    try {
        return run();
    } catch (const InputError& error) {
        return failed(bad_input, error.what());
    } catch (const SolveError& error) {
        return failed(no_solution, error.what());
    } catch (const ExchangeError& error) {
        return failed(bad_file, error.what());
    } catch (const Cancelled& error) {
        return failed(cancelled, fmt::format("{}; finished files are kept", error.what()));
    } catch (const std::bad_alloc&) {
        return failed(no_solution, "there is not enough memory for this part");
    } catch (const std::exception& error) {
        return failed(internal, (std::string("internal error of the program: ") + error.what()));
    }
}

} // namespace

int main(int count, char** values)
{
    // Messages of libraries belong to the standard error; the standard output is for results.
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>("spia", std::make_shared<spdlog::sinks::stderr_sink_mt>()));
    spdlog::set_level(spdlog::level::warn);

    CLI::App app{
        "SPIA: from a stamped sheet-metal part to its flat blank, with the forming strains, and to a NURBS surface."};
    app.set_version_flag("--version", SPIA_VERSION);
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 done, 1 poorer result with --strict, 2 faulty input, 3 no solution, 4 a file cannot be read or "
        "written, 130 cancelled (`unfold` leaves the states of the steps that are done).");
    int threads = 0;
    std::vector<std::function<int()>> runs;
    for (const cli::Subcommand& each : subcommands) {
        CLI::App& command = *app.add_subcommand(each.name, each.synopsis);
        runs.push_back(each.add(command));
        if (each.parallel)
            command
                .add_option("--threads", threads,
                            "maximum number of threads (default: all); the result does not depend on it")
                ->type_name("N")
                ->check(CLI::Range(1, 1024));
    }

    if (const std::string empty = empty_word(count, values); !empty.empty())
        return failed(bad_input, empty);
    try {
        std::vector<std::string> words = arguments_of(count, values);
        std::reverse(words.begin(), words.end()); // as CLI11 wants them
        app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? fine : bad_input;
    }
    std::optional<tbb::global_control> limit;
    if (threads > 0)
        limit.emplace(tbb::global_control::max_allowed_parallelism, size_t(threads));
    for (size_t k = 0; k < runs.size(); ++k)
        if (app.got_subcommand(subcommands[k].name))
            return done(runs[k]);
    return fine;
}
