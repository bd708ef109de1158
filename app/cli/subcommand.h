#pragma once
#include <functional>
#include <memory>

#include "app/cli/commands.h"

namespace CLI {
class App;
}

namespace spia::cli {

/// Tells the parser what each subcommand takes. The arguments have to outlive it.
void add_arguments(CLI::App& command, RunArguments& run);
void add_arguments(CLI::App& command, InfoArguments& info);
void add_arguments(CLI::App& command, CompareArguments& comparison);
void add_arguments(CLI::App& command, UnfoldArguments& unfolding);
void add_arguments(CLI::App& command, FitArguments& fit);

/// A word after `spia`.
struct Subcommand {
    const char* name;
    const char* synopsis;
    bool parallel; ///< it takes --threads
    /// Adds its arguments to the parser. @returns what is done with them, once they are parsed;
    /// gives the exit code
    std::function<int()> (*add)(CLI::App& command);
};

/// Subcommand::add of what a function does with arguments.
template <class Arguments, int (*run)(const Arguments&)> std::function<int()> with_arguments(CLI::App& command)
{
    const auto arguments = std::make_shared<Arguments>();
    add_arguments(command, *arguments);
    return [arguments] { return run(*arguments); };
}

} // namespace spia::cli
