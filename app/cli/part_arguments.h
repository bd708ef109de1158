#pragma once
#include <CLI/CLI.hpp>

#include "app/cli/commands.h"

namespace spia::cli {

/// The first word behind the subcommand: the file of the part.
void add_part(CLI::App& command, std::filesystem::path& part);

/// What is read of the file, and how. The same for all subcommands.
void add_choice_of_parts(CLI::App& command, std::vector<std::string>& parts);
void add_cad(CLI::App& command, CadArguments& cad);
void add_remesh(CLI::App& command, RemeshArguments& remesh);
void add_repairs(CLI::App& command, std::string& unit, std::optional<double>& weld, bool& keep_largest);

/// Of the sheet.
void add_rolling(CLI::App& command, std::vector<double>& rolling);
void add_direction(CLI::App& command, std::vector<double>& direction);

/// Of files.
void add_dxf(CLI::App& command, DxfArguments& dxf);
/// Words of a list, of which there are no others.
CLI::Option* add_list(CLI::App& command, const char* name, std::vector<std::string>& chosen,
                      const std::vector<std::string>& all, const char* help);

} // namespace spia::cli
