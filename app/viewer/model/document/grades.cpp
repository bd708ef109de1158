#include "app/viewer/model/document/grades.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/model/document/recent_files.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/forming/material/fit_hardening.h"
#include "engine/forming/material/material_library.h"

namespace fs = std::filesystem;

namespace spia::viewer {
namespace {

Grade read_grade(const fs::path& file, bool own)
{
    Grade grade{file, own, own ? file.string() : file.stem().string(), {}, {}};
    try {
        grade.material = read_material(file);
    } catch (const std::exception& error) {
        grade.problem = error.what();
    }
    return grade;
}

} // namespace

fs::path own_materials()
{
    try {
        return config_folder() / "materials";
    } catch (const Error&) {
        return {};
    }
}

std::vector<Grade> read_grades(const fs::path& built_in, const fs::path& own)
{
    std::vector<Grade> grades;
    for (const auto& [folder, is_own] : {std::pair(built_in, false), {own, true}})
        try {
            for (const fs::path& file : material_files(folder))
                grades.push_back(read_grade(file, is_own));
        } catch (const InputError&) { // no such folder, or an empty one: no grades
        }
    return grades;
}

const Grade* grade_called(const std::vector<Grade>& grades, const std::string& name)
{
    const auto find = [&](const auto& is) {
        const auto found = std::find_if(grades.begin(), grades.end(), is);
        return found == grades.end() ? nullptr : &*found;
    };
    if (const Grade* grade = find([&](const Grade& each) { return each.reference == name; }))
        return grade;
    const std::string wanted = lower_case(name);
    if (const Grade* grade = find([&](const Grade& each) { return lower_case(each.label()) == wanted; }))
        return grade;
    return find([&](const Grade& each) { return each.material && lower_case(each.material->name) == wanted; });
}

std::string stem_for(const std::string& name)
{
    std::string stem;
    bool gap = false;
    for (const char c : lower_case(name)) {
        const bool kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
        if (kept && gap && !stem.empty())
            stem += '_';
        gap = !kept;
        if (kept)
            stem += c;
    }
    return stem;
}

std::string copy_name(const std::vector<Grade>& grades, const std::string& name)
{
    std::string candidate = name + " copy";
    for (int k = 2; grade_called(grades, candidate) || grade_called(grades, stem_for(candidate)); ++k)
        candidate = fmt::format("{} copy {}", name, k);
    return candidate;
}

std::vector<MaterialFault> faults_to_save(const std::vector<Grade>& grades, const Material& material,
                                          const std::string& replaces)
{
    std::vector<MaterialFault> faults = faults_of(material);
    const std::string stem = stem_for(material.name);
    if (!faults.empty() && faults.front().key == "name")
        return faults;
    const auto blame = [&](std::string what) { faults.insert(faults.begin(), {"name", std::move(what), {}}); };
    constexpr size_t longest = 100; // a file name has room for 255 bytes
    if (stem.empty())
        blame("must have a letter or a digit: the file is called after it");
    else if (stem.size() > longest)
        blame(fmt::format("must not be longer than {} characters", longest));
    else
        for (const std::string& label : {material.name, stem})
            if (const Grade* other = grade_called(grades, label); other && other->reference != replaces) {
                blame(fmt::format("{} has this name; choose another",
                                  other->own ? "another grade of your own" : "a built-in grade"));
                break;
            }
    return faults;
}

GradeFigures grade_figures(const Material& material)
{
    constexpr double most = 0.99, first = 0.10, last = 0.20;
    const auto stress = [&](double strain) { return flow_stress(material.hardening, strain).stress; };
    GradeFigures figures;
    figures.proof_MPa = stress(0.002);
    figures.uniform_strain = uniform_strain(material.hardening, most);
    figures.strength_MPa = stress(figures.uniform_strain) * std::exp(-figures.uniform_strain);
    const double high = std::min(last, figures.uniform_strain), low = high * first / last;
    figures.n = high > 0 ? std::log(stress(high) / stress(low)) / std::log(high / low) : 0;
    figures.normal_anisotropy = material.normal_anisotropy();
    figures.planar_anisotropy = (material.r0 - 2 * material.r45 + material.r90) / 2;
    return figures;
}

FlowCurve flow_curve(const Hardening& law, double most, int pieces)
{
    FlowCurve curve;
    for (int k = 0; k <= pieces; ++k) {
        curve.strain.push_back(most * k / pieces);
        curve.stress_MPa.push_back(flow_stress(law, curve.strain.back()).stress);
    }
    return curve;
}

Hardening as_law(const Hardening& law, const std::string& name)
{
    if (name == law_name(law))
        return law;
    constexpr double least = 0.002, most = 0.5;
    if (name == "table") {
        HardeningTable table;
        for (const double strain : {0., 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5}) {
            const double stress = flow_stress(law, strain).stress;
            if (stress > 0) { // Hollomon's law begins at none
                table.strain.push_back(strain);
                table.stress_MPa.push_back(stress);
            }
        }
        return table;
    }
    constexpr int points = 60;
    Eigen::VectorXd strain(points), stress(points);
    for (int k = 0; k < points; ++k) {
        // closer where the curve bends
        strain[k] = least * std::pow(most / least, double(k) / (points - 1));
        stress[k] = flow_stress(law, strain[k]).stress;
    }
    for (const LawFit& fit : fit_hardening(strain, stress))
        if (fit.name == name) {
            if (!fit.law)
                throw InputError(fmt::format("{} does not fit the curve: {}", name, fit.reason));
            return *fit.law;
        }
    throw InputError(fmt::format("there is no hardening law \"{}\"", name));
}

} // namespace spia::viewer
