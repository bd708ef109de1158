#include "app/viewer/model/actions/remedies.h"

#include "engine/mesh/topology.h"

namespace spia::viewer {
namespace {

SetGrid with(GridOptions grid, GridMethod method)
{
    grid.method = method;
    return {std::move(grid)};
}

std::vector<Action> confirmed(const Document& document)
{
    std::vector<Action> actions;
    if (!is_given(document.thickness_from))
        actions.push_back(SetThickness{document.session.options.flatten.thickness});
    if (!is_given(document.material_from))
        actions.push_back(SetMaterial{document.material});
    return actions;
}

} // namespace

std::vector<Action> actions_of(const Doubt& doubt, const Document& document)
{
    const SessionOptions& options = document.session.options;
    switch (doubt.remedy) {
    case Remedy::none: return {};
    case Remedy::confirm_sheet: return confirmed(document);
    case Remedy::propose_steps: return {ProposeSteps{}};
    case Remedy::cut_corners: return {SetSeam{{SeamOptions::Mode::corners}}};
    case Remedy::harmonic_grid: return {with(options.grid, GridMethod::harmonic)};
    case Remedy::read_in_other_unit: {
        if (!document.session.part)
            return {};
        const PartFile& part = *document.session.part;
        const auto unit = likelier_unit(part, bounding_diagonal(part.mesh), options.flatten.thickness);
        return unit ? std::vector<Action>{SetUnit{std::string(name(*unit))}} : std::vector<Action>{};
    }
    case Remedy::finer_grid: {
        GridOptions grid = options.grid;
        grid.cells = finer_cells(grid);
        grid.columns = grid.rows = 0;
        return {SetGrid{grid}};
    }
    case Remedy::fit_within_tolerance: {
        FitChoice fit = fit_choice(options);
        fit.tolerance = usual_tolerance;
        return {SetFit{fit}};
    }
    case Remedy::looser_tolerance: {
        if (!document.session.surface)
            return {};
        FitChoice fit = fit_choice(options);
        fit.tolerance = reached_tolerance(*document.session.surface);
        return {SetFit{fit}};
    }
    case Remedy::more_control_points: {
        FitChoice fit = fit_choice(options);
        fit.max_control_points = more_control_points(fit.max_control_points);
        return {SetFit{fit}};
    }
    case Remedy::several_patches: return {SetPatches{LayoutOptions{}}};
    }
    return {};
}

} // namespace spia::viewer
