#include "app/viewer/model/reports/comparison.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <fmt/core.h>
#include <utility>

#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/jobs/viewer_model.h"
#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "engine/report/figures/figures.h"
#include "engine/report/text/lengths.h"

namespace spia::viewer {
namespace {

std::string time_of_day()
{
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    return fmt::format("{:02}:{:02}", local.tm_hour, local.tm_min);
}

SheetFields less(const SheetFields& now, const SheetFields& reference)
{
    SheetFields result = now;
    result.thickness -= reference.thickness;
    result.thinning -= reference.thinning;
    result.strain_major -= reference.strain_major;
    result.strain_minor -= reference.strain_minor;
    result.strain_equivalent -= reference.strain_equivalent;
    result.stress_major -= reference.stress_major;
    result.stress_minor -= reference.stress_minor;
    result.stress_equivalent -= reference.stress_equivalent;
    return result;
}

double distance_to_piece(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
    const Eigen::Vector2d along = b - a;
    const double length = along.squaredNorm(), t = length > 0 ? std::clamp((p - a).dot(along) / length, 0., 1.) : 0;
    return (a + t * along - p).norm();
}

/// The greatest distance of a corner of the outlines to the outlines of the other one.
double greatest_distance(const std::vector<std::vector<int>>& loops, const Eigen::Matrix2Xd& from,
                         const Eigen::Matrix2Xd& to)
{
    double greatest = 0;
    for (const auto& loop : loops)
        for (const int v : loop) {
            const Eigen::Vector2d p = from.col(v);
            double nearest = (to.col(v) - p).norm();
            for (const auto& other : loops)
                // less than the greatest adds nothing
                for (size_t i = 0; i < other.size() && nearest > greatest; ++i)
                    nearest = std::min(nearest,
                                       distance_to_piece(p, to.col(other[i]), to.col(other[(i + 1) % other.size()])));
            greatest = std::max(greatest, nearest);
        }
    return greatest;
}

std::optional<double> at_risk(const std::shared_ptr<const LimitsResult>& limits)
{
    if (!limits)
        return {};
    return double(limits->zones.share[size_t(Zone::risk)].faces + limits->zones.share[size_t(Zone::crack)].faces);
}

} // namespace

Reference reference_of(const Document& document, std::string name, LengthUnit lengths)
{
    const Session& session = document.session;
    if (!session.part || !session.blank)
        throw InputError("There is no result to keep as reference: unfold the part first.");
    const FlattenOptions& made = document.made_with.flatten;
    if (name.empty())
        name = fmt::format("{}, {}, {}", made.material.name, thickness_text(made.thickness, lengths), time_of_day());
    return {std::move(name), session.part, session.blank, session.limits};
}

Eigen::Matrix2Xd laid_over(const Eigen::Matrix2Xd& points, const Eigen::Matrix2Xd& onto)
{
    const Eigen::Vector2d centre = points.rowwise().mean(), there = onto.rowwise().mean();
    const Eigen::Matrix2Xd a = points.colwise() - centre, b = onto.colwise() - there;
    const double cosine = (a.array() * b.array()).sum(),
                 sine = (a.row(0).array() * b.row(1).array() - a.row(1).array() * b.row(0).array()).sum();
    Eigen::Matrix2d turn = Eigen::Rotation2Dd(std::atan2(sine, cosine)).toRotationMatrix();
    return (turn * a).colwise() + there;
}

Differences differences_of(const std::shared_ptr<const Reference>& reference, const Session& now)
{
    Differences result{reference, now.part, now.blank, {}, {}, {}, 0};
    const TriMesh &before = reference->part->mesh, &mesh = now.part->mesh;
    if (before.vertices() != mesh.vertices() || before.triangle.cols() != mesh.triangle.cols() ||
        before.triangle != mesh.triangle) {
        result.none_because = fmt::format(
            "The mesh of the part has changed ({} triangles instead of {}): only the key figures can be compared.",
            mesh.triangles(), before.triangles());
        return result;
    }
    auto fields = std::make_shared<FlattenResult>(*now.blank);
    fields->face = less(now.blank->face, reference->blank->face);
    fields->node = less(now.blank->node, reference->blank->node);
    result.fields = fields;
    result.outline = laid_over(reference->blank->blank.position, now.blank->blank.position);
    const auto loops = boundary_loops(mesh);
    result.outline_distance = std::max(greatest_distance(loops, result.outline, now.blank->blank.position),
                                       greatest_distance(loops, now.blank->blank.position, result.outline));
    return result;
}

bool has_difference(Field field) { return field >= Field::thickness && field <= Field::stress_equivalent; }

const std::shared_ptr<const FlattenResult>& blank_of_field(const ViewerState& state)
{
    return state.document.display.difference && state.differences && state.differences->fields
               ? state.differences->fields
               : state.document.session.blank;
}

Session session_of_field(const ViewerState& state)
{
    Session session = state.document.session;
    session.blank = blank_of_field(state);
    return session;
}

std::string label_of_field(const ViewerState& state)
{
    const FieldDisplay& display = state.document.display;
    return std::string(info(display.field).label) + (display.difference ? ", difference from reference" : "");
}

std::vector<ComparedFigure> compared_figures(const Reference& reference, const Session& now)
{
    const SheetFigures a = without_noise(sheet_figures(reference.blank->face)),
                       b = without_noise(sheet_figures(now.blank->face));
    const BlankSize before = blank_size(reference.part->mesh, reference.blank->blank),
                    after = blank_size(now.part->mesh, now.blank->blank);
    return {{"Blank, longer side", "mm", before.sides().maxCoeff(), after.sides().maxCoeff(), 2},
            {"Blank, shorter side", "mm", before.sides().minCoeff(), after.sides().minCoeff(), 2},
            {"Area of the blank", "mm\u00b2", before.area, after.area, 0},
            {"Maximum thinning", "%", 100 * a.thinning[1], 100 * b.thinning[1], 2},
            {"Minimum thinning (negative: thicker)", "%", 100 * a.thinning[0], 100 * b.thinning[0], 2},
            {"Maximum equivalent strain", "", a.strain_equivalent, b.strain_equivalent, 4},
            {"Faces cracked or at risk", "", at_risk(reference.limits), at_risk(now.limits), 0},
            {"Time to solve", "s", reference.blank->report.seconds, now.blank->report.seconds, 2}};
}

ComparedFigure in_unit(ComparedFigure figure, LengthUnit lengths)
{
    const ShownUnit as = as_shown(figure.unit, lengths);
    if (as.unit == figure.unit)
        return figure;
    for (auto* value : {&figure.reference, &figure.now})
        if (*value)
            **value *= as.factor;
    // of areas
    figure.decimals += figure.unit == "mm" ? more_decimals(lengths) : more_decimals(lengths) + 1;
    figure.unit = as.unit;
    return figure;
}

void ViewerModel::follow_reference()
{
    const Session& session = state_.document.session;
    FieldDisplay& display = state_.document.display;
    const auto& known = state_.differences;
    if (!state_.reference || !session.part || !session.blank)
        state_.differences = nullptr;
    else if (!known || known->reference != state_.reference || known->blank != session.blank ||
             known->part != session.part)
        state_.differences = std::make_shared<const Differences>(differences_of(state_.reference, session));
    display.difference &= known && known->fields && has_difference(display.field);
}

} // namespace spia::viewer
