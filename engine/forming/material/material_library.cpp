#include "engine/forming/material/material_library.h"

#include <algorithm>
#include <fmt/core.h>
#include <map>
#include <numeric>
#include <system_error>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/text.h"

namespace spia {
namespace {

namespace fs = std::filesystem;

/// The letters and digits alone, since "AA6016-T4" is meant to be as close to "aa6016_t4" as can
/// be.
std::string squeezed(const std::string& text)
{
    std::string result;
    for (const char c : lower_case(text))
        if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))
            result += c;
    return result;
}

/// How far what was typed is from a label, by the letters to be inserted, removed or replaced
/// (Levenshtein): first to make it a part of the label, since a whole word like "copper" says more
/// than its length, then to make it the label.
std::pair<size_t, size_t> distance(const std::string& typed, const std::string& label)
{
    const auto edits = [&](bool part) {
        std::vector<size_t> row(label.size() + 1, 0);
        if (!part)
            std::iota(row.begin(), row.end(), size_t{0});
        for (size_t i = 1; i <= typed.size(); ++i) {
            size_t diagonal = row[0];
            row[0] = i;
            for (size_t j = 1; j <= label.size(); ++j) {
                const size_t replaced = diagonal + (typed[i - 1] == label[j - 1] ? 0 : 1);
                diagonal = row[j];
                row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
            }
        }
        return part ? *std::min_element(row.begin(), row.end()) : row.back();
    };
    return {edits(true), edits(false)};
}

/// Does it name a file even if there is none?
bool looks_like_path(const fs::path& path)
{
    return path.has_parent_path() || lower_case(path.extension().string()) == ".json";
}

[[noreturn]] void fail_unknown(const std::string& wanted, const std::vector<fs::path>& files,
                               const std::vector<Material>& materials)
{
    const std::string typed = squeezed(looks_like_path(wanted) ? fs::path(wanted).stem().string() : wanted);
    std::string known;
    size_t closest = 0;
    std::pair<size_t, size_t> least(std::string::npos, 0);
    for (size_t i = 0; i < files.size(); ++i) {
        const std::string stem = files[i].stem().string();
        known += (i > 0 ? ", " : "") + stem;
        for (const std::string& label : {stem, materials[i].name}) {
            const auto candidate = distance(typed, squeezed(label));
            if (candidate < least) {
                least = candidate;
                closest = i;
            }
        }
    }
    throw InputError(
        fmt::format("there is no material and no file \"{}\"; did you mean {} ({})? Known are {}; a path to a file of "
                    "your own works too, see assets/materials/README.md for the form",
                    wanted, files[closest].stem().string(), materials[closest].name, known));
}

} // namespace

std::vector<fs::path> material_files(const fs::path& folder)
{
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code unreadable; // a dangling link is no grade
        if (entry->path().extension() == ".json" && entry->is_regular_file(unreadable))
            files.push_back(entry->path());
    }
    if (error)
        throw InputError(fmt::format("cannot read the folder of materials {}: {}", folder.string(), error.message()));
    if (files.empty())
        throw InputError(fmt::format("the folder of materials {} holds no *.json", folder.string()));
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<Material> read_materials(const fs::path& folder)
{
    std::vector<Material> materials;
    std::map<std::string, fs::path> owners;
    const auto claim = [&owners](const std::string& label, const fs::path& file) {
        const auto [owner, is_new] = owners.emplace(lower_case(label), file);
        if (!is_new && owner->second != file)
            throw InputError(fmt::format("\"{}\" means two materials, {} and {}; rename one", label,
                                         owner->second.string(), file.string()));
    };
    for (const fs::path& file : material_files(folder)) {
        materials.push_back(read_material(file));
        claim(file.stem().string(), file);
        claim(materials.back().name, file);
    }
    return materials;
}

Material find_material(const std::string& name_or_file, const fs::path& folder)
{
    const fs::path own = name_or_file;
    std::error_code error; // no such file is no fault here
    const bool is_file = fs::is_regular_file(own, error);
    if (is_file && looks_like_path(own))
        return read_material(own); // even if the folder is missing
    const std::string wanted = lower_case(name_or_file);
    const std::vector<fs::path> files = material_files(folder);
    // By the stem first, without the other files: a spoilt one must not keep the user from a good
    // one.
    for (const fs::path& file : files)
        if (lower_case(file.stem().string()) == wanted)
            return read_material(file);
    const std::vector<Material> materials = read_materials(folder);
    for (const Material& material : materials)
        if (lower_case(material.name) == wanted)
            return material;
    if (is_file)
        return read_material(own);
    fail_unknown(name_or_file, files, materials);
}

} // namespace spia
