#include <algorithm>
#include <fmt/core.h>
#include <system_error>

#include "app/viewer/model/actions/apply.h"
#include "app/viewer/model/document/grades.h"
#include "engine/core/atomic_file.h"
#include "engine/forming/material/material_text.h"

namespace spia::viewer {
namespace {

/// Whether the part or one of its regions is of this grade.
bool is_used(const Document& document, const std::string& reference)
{
    return document.material == reference ||
           std::any_of(document.regions.begin(), document.regions.end(),
                       [&](const FaceRegion& region) { return region.sheet && region.sheet->material == reference; });
}

const Grade& own_grade(const std::vector<Grade>& grades, const std::string& name)
{
    const Grade* grade = grade_called(grades, name);
    if (!grade)
        throw InputError(fmt::format("There is no grade \"{}\" among your own.", name));
    if (!grade->own)
        throw InputError(
            fmt::format("{} is built in and cannot be changed; copy it as your own first.", grade->label()));
    return *grade;
}

} // namespace

void ViewerModel::Apply::operator()(const SaveMaterial& action)
{
    const std::filesystem::path folder = own_materials(), built_in = model.assets() / "materials";
    if (folder.empty())
        throw ExchangeError("There is no home folder to keep a grade in; set the environment variable HOME.");
    const std::vector<Grade> grades = read_grades(built_in, folder);
    const std::string before = action.replaces.empty() ? std::string() : own_grade(grades, action.replaces).reference;
    if (const auto faults = faults_to_save(grades, action.material, before); !faults.empty())
        throw InputError(fmt::format("The grade cannot be saved: {} {}.", faults.front().key, faults.front().what));
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw ExchangeError(
            fmt::format("cannot make the folder {}: {}; check who may write there", folder.string(), error.message()));
    const std::filesystem::path file = folder / (stem_for(action.material.name) + ".json");
    write_atomically(file, material_text(action.material));
    const std::string now = file.string();
    if (!before.empty() && before != now)
        std::filesystem::remove(before, error);
    state.grades = std::make_shared<const std::vector<Grade>>(read_grades(built_in, folder));
    if (is_used(document, before.empty() ? now : before))
        change_material("Change material", [&](Document& edited) {
            const std::string old = before.empty() ? now : before;
            if (edited.material == old) {
                edited.material = now;
                edited.session.options.flatten.material = action.material;
            }
            for (FaceRegion& region : edited.regions)
                if (region.sheet && region.sheet->material == old)
                    region.sheet->material = now;
        });
    model.say(Severity::done, fmt::format("The grade {} was saved as {}.", action.material.name, now));
}

void ViewerModel::Apply::operator()(const RemoveMaterial& action)
{
    const std::filesystem::path folder = own_materials(), built_in = model.assets() / "materials";
    const std::vector<Grade> grades = read_grades(built_in, folder);
    const Grade& grade = own_grade(grades, action.material);
    if (is_used(document, grade.reference))
        throw InputError(fmt::format("{} is the material of this part; choose another one first.", grade.label()));
    std::error_code error;
    if (!std::filesystem::remove(grade.file, error) || error)
        throw ExchangeError(fmt::format("cannot remove {}: {}; check who may write there", grade.file.string(),
                                        error ? error.message() : "it was removed already"));
    state.grades = std::make_shared<const std::vector<Grade>>(read_grades(built_in, folder));
    model.say(Severity::done, fmt::format("The grade {} was removed.", grade.label()));
}

} // namespace spia::viewer
