#pragma once
#include <CLI/CLI.hpp>

#include "app/cli/commands.h"

namespace spia::cli {

/// The first word behind the subcommand: the file of the part.
void add_part(CLI::App& command, std::filesystem::path& part);

/// What is read of the file, and how. The same for all subcommands.
void add_reading(CLI::App& command, ReadArguments& read);
/// Of that what `compare` does not take.
void add_remesh(CLI::App& command, RemeshArguments& remesh);

/// Of the sheet.
void add_rolling(CLI::App& command, std::vector<double>& rolling);
void add_direction(CLI::App& command, std::vector<double>& direction);

/// Of files.
void add_dxf(CLI::App& command, DxfArguments& dxf);
/// Words of a list, of which there are no others.
CLI::Option* add_list(CLI::App& command, const char* name, std::vector<std::string>& chosen,
                      const std::vector<std::string>& all, const char* help);

} // namespace spia::cli
