#include "engine/pipeline/outputs/unfold_outputs.h"

#include <algorithm>
#include <fmt/core.h>
#include <initializer_list>
#include <system_error>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/exchange/lines/blank_outline.h"
#include "engine/exchange/lines/write_dxf.h"
#include "engine/exchange/mesh/write_vtu.h"
#include "engine/pipeline/blank/bends_for_shop.h"
#include "engine/pipeline/blank/drawn_blank.h"
#include "engine/pipeline/files/line_file.h"
#include "engine/pipeline/outputs/deck_outputs.h"

namespace spia {
namespace {

std::vector<std::string> without(std::vector<std::string> formats, const std::string& one)
{
    std::erase(formats, one);
    return formats;
}

} // namespace

const std::vector<std::string>& unfold_formats()
{
    static const std::vector<std::string> formats = {"vtu", "dxf", "iges", "step", "states"};
    return formats;
}

const std::vector<std::string>& all_unfold_formats()
{
    static const std::vector<std::string> formats = [] {
        std::vector<std::string> all = unfold_formats();
        all.insert(all.end(), blank_mesh_formats().begin(), blank_mesh_formats().end());
        return all;
    }();
    return formats;
}

std::vector<SheetLine> blank_lines(const TriMesh& part, const BendMap& map, const Blank& blank)
{
    std::vector<SheetLine> lines;
    for (const OutlineLoop& loop : blank_outline(part, blank)) {
        Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, loop.cols());
        points.topRows<2>() = loop;
        lines.push_back({lines.empty() ? "outline" : fmt::format("hole {}", lines.size()), points, true});
    }
    for (SheetLine& bend : bend_lines(part, map, blank.position))
        lines.push_back(std::move(bend));
    return lines;
}

void prepare_folder(const std::filesystem::path& folder)
{
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed)
        throw ExchangeError(
            fmt::format("cannot make the folder {}: {}; choose another one", folder.string(), failed.message()));
    require_writable(folder / "spia-unfold");
}

void remove_unfolding(const std::filesystem::path& folder, const std::string& name)
{
    const auto ends_in = [](const std::string& text, std::initializer_list<const char*> endings) {
        return std::any_of(endings.begin(), endings.end(), [&](const char* ending) { return text == ending; });
    };
    std::vector<std::filesystem::path> old;
    std::error_code failed;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
        const std::string file = entry.path().filename().string();
        if (file.compare(0, name.size() + 1, name + "-") != 0)
            continue;
        std::string rest = file.substr(name.size() + 1);
        if (rest.compare(0, 4, "step") == 0) {
            size_t digits = 4;
            while (digits < rest.size() && rest[digits] >= '0' && rest[digits] <= '9')
                ++digits;
            rest = digits > 4 ? "step" + rest.substr(digits) : rest;
        }
        if (ends_in(rest,
                    {"step.vtu", "step-trim.dxf", "step-trim.iges", "step-trim.step", "blank.dxf", "blank.iges",
                     "blank.step", "blank.k", "blank.bdf", "blank.inp", "blank.msh", "polished.dxf", "polished.vtu"}))
            old.push_back(entry.path());
    }
    for (const auto& file : old)
        if (std::filesystem::remove(file, failed); failed)
            throw ExchangeError(fmt::format("{} of an earlier run cannot be removed: {}; choose another folder or name",
                                            file.string(), failed.message()));
}

std::vector<std::filesystem::path> write_unfolding(const std::filesystem::path& folder, const std::string& name,
                                                   const PartFile& part, const BendMap& map, const UnfoldScript& steps,
                                                   const UnfoldRun& run, const FlattenResult* polished,
                                                   const std::vector<std::string>& formats, const DxfOptions& dxf,
                                                   const BendTable* table)
{
    std::vector<std::filesystem::path> files;
    const auto wanted = [&](const char* format) {
        return std::find(formats.begin(), formats.end(), format) != formats.end();
    };
    const auto add = [&](const std::vector<std::filesystem::path>& more) {
        files.insert(files.end(), more.begin(), more.end());
    };
    for (size_t k = 0; k < run.states.size(); ++k) {
        const UnfoldState& state = run.states[k];
        const std::string stem = fmt::format("{}-step{}", name, k + 1);
        if (wanted("vtu")) {
            const std::pair<std::string, const Eigen::VectorXi*> numbers[] = {{"step", &state.step},
                                                                              {"region", &map.label}};
            files.push_back(folder / (stem + ".vtu"));
            write_state_vtu(files.back(), part.mesh, state.position, state.face, numbers);
        }
        if (steps[k].kind == UnfoldKind::lay)
            if (const auto trim = trim_lines(part.mesh, state.position, steps[k].pick.freed); !trim.empty())
                add(write_line_files(folder, stem + "-trim", trim, formats));
    }
    if (!run.blank)
        return files;
    if (wanted("dxf")) {
        files.push_back(folder / (name + "-blank.dxf"));
        write_dxf(files.back(),
                  drawn_blank(part, bends_for_shop(part), *run.blank, run.states.back().face, true, table), dxf);
    }
    add(write_deck_files(folder, name, formats, part, *run.blank, run.states.back().face));
    add(write_line_files(folder, name + "-blank", blank_lines(part.mesh, map, *run.blank), without(formats, "dxf")));
    if (polished && wanted("dxf")) {
        files.push_back(folder / (name + "-polished.dxf"));
        write_dxf(files.back(), drawn_blank(part, bends_for_shop(part), polished->blank, polished->face, true), dxf);
    }
    if (polished && wanted("vtu")) {
        files.push_back(folder / (name + "-polished.vtu"));
        write_vtu(files.back(), part.mesh, polished->blank, polished->face, polished->node);
    }
    return files;
}

} // namespace spia
