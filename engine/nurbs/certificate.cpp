#include "engine/nurbs/certificate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/place_text.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/bezier.h"
#include "engine/nurbs/evaluate.h"

namespace spia {

namespace {

constexpr double gauss_place[] = {-0.861136311594052575, -0.339981043584856265, 0.339981043584856265,
                                  0.861136311594052575};
constexpr double gauss_share[] = {0.347854845137453857, 0.652145154862546143, 0.652145154862546143,
                                  0.347854845137453857};

/// Of the largest coefficient of a piece: what rounding may have done to the others.
constexpr double rounding = 1e-12;

/// Halvings of a span along each direction before it is given up: 1/1024 of it. Where S_u x S_v is
/// not zero so few are needed that the bound is met near a fold only.
constexpr int most_halvings = 10;

constexpr const char* proving = "proving that nothing folds";
constexpr const char* examining = "judging the shape of the surface";

void require_patch(const NurbsSurface& s, size_t number)
{
    if (s.degree_u < 1 || s.degree_v < 1 || s.degree_u > max_degree || s.degree_v > max_degree ||
        int(s.knots_u.size()) != s.count_u + s.degree_u + 1 || int(s.knots_v.size()) != s.count_v + s.degree_v + 1 ||
        s.control.cols() != s.count_u * s.count_v || s.weight.size() != s.control.cols())
        throw InputError(
            fmt::format("patch {} cannot be examined: its degrees, counts and knots do not go together, or a "
                        "degree is above {}; fit it again",
                        number + 1, max_degree));
}

/// The first indices of the knots that begin a span of some length.
std::vector<int> spans(const std::vector<double>& knots, int degree)
{
    std::vector<int> result;
    for (size_t k = size_t(degree); k + size_t(degree) + 1 < knots.size(); ++k)
        if (knots[k] < knots[k + 1])
            result.push_back(int(k));
    return result;
}

/// A positive multiple of S_u x S_v over a span: times w^3 and the lengths of the span.
BezierPatch numerator(const BezierPatch& homogeneous, bool rational)
{
    const BezierPatch A = rows(homogeneous, 0, 3), A_s = derivative_s(A), A_t = derivative_t(A);
    if (!rational)
        return cross(A_s, A_t);
    const BezierPatch w = rows(homogeneous, 3, 1);
    return sum(times(w, cross(A_s, A_t)),
               sum(times(derivative_t(w), cross(A, A_s)), times(derivative_s(w), cross(A_t, A))));
}

struct Piece {
    BezierPatch normal; ///< numerator()
    double u0, u1, v0, v1;
    int depth = 0;
};

/// A lower bound of the numerator's length if all coefficients are on one side of their mean, else
/// 0.
double lower_bound(const BezierPatch& normal)
{
    const Eigen::Vector3d mean = normal.coefficient.rowwise().sum();
    const double length = mean.norm(), largest = normal.coefficient.colwise().norm().maxCoeff();
    if (!(length > 0))
        return 0;
    const double least = (mean.transpose() * normal.coefficient).minCoeff() / length;
    return least > rounding * largest ? least : 0;
}

PatchPlace place_of(const NurbsSurface& surface, double u, double v)
{
    return {u, v, evaluate(surface, u, v).position};
}

/// Whether normals at places of a piece's span point to both sides of one another.
bool turns_round(const BezierPatch& span)
{
    constexpr int n = 9;
    std::vector<Eigen::Vector3d> normals;
    const auto power = [](int degree, double t, int i) {
        double value = 1;
        for (int k = 0; k < i; ++k)
            value *= t * (degree - k) / (k + 1);
        return value * std::pow(1 - t, degree - i);
    };
    const double largest = span.coefficient.colwise().norm().maxCoeff();
    for (int b = 0; b < n; ++b)
        for (int a = 0; a < n; ++a) {
            Eigen::Vector3d value = Eigen::Vector3d::Zero();
            for (int j = 0; j <= span.degree_t; ++j)
                for (int i = 0; i <= span.degree_s; ++i)
                    value +=
                        power(span.degree_s, a / (n - 1.), i) * power(span.degree_t, b / (n - 1.), j) * span.at(i, j);
            if (value.norm() > 1e-9 * largest)
                normals.push_back(value.normalized());
        }
    return std::any_of(normals.begin(), normals.end(), [&](const Eigen::Vector3d& one) {
        return std::any_of(normals.begin(), normals.end(),
                           [&](const Eigen::Vector3d& other) { return one.dot(other) < 0; });
    });
}

/// Proves one span, halving it where its coefficients do not show it. @returns the bound of its
/// pieces; 0: refused
double prove_span(const NurbsSurface& surface, const Piece& whole, PatchCertificate& certificate,
                  const Progress& progress)
{
    constexpr int pieces_at_a_time = 1024; // halvings of a span close to a fold may be many
    std::vector<Piece> open{whole};
    double bound = std::numeric_limits<double>::infinity();
    while (!open.empty()) {
        const Piece piece = std::move(open.back());
        open.pop_back();
        if (++certificate.pieces % pieces_at_a_time == 0)
            progress.checkpoint(0, proving);
        if (const double least = lower_bound(piece.normal); least > 0) {
            bound = std::min(bound, least);
            continue;
        }
        const double u = (piece.u0 + piece.u1) / 2, v = (piece.v0 + piece.v1) / 2;
        if (piece.depth == most_halvings) {
            const BezierPatch around = piece.normal;
            const bool folded = turns_round(around) || turns_round(whole.normal);
            certificate.refusal = {folded ? Refusal::Why::folded : Refusal::Why::vanishes, place_of(surface, u, v)};
            return 0;
        }
        for (const bool late : {true, false}) // the first quarter is taken first
            for (const bool right : {true, false})
                open.push_back({half_t(half_s(piece.normal, right), late), right ? u : piece.u0, right ? piece.u1 : u,
                                late ? v : piece.v0, late ? piece.v1 : v, piece.depth + 1});
    }
    return bound;
}

/// Proves that the normals on two sides of a line keep within 90 degrees: rows of coefficients
/// along it, both of one degree.
/// @returns where they do not, from 0 to 1 along the line
std::optional<double> kink(Eigen::MatrixXd left, Eigen::MatrixXd right)
{
    struct Part {
        Eigen::MatrixXd left, right;
        double from, to;
        int depth;
    };
    const auto half = [](const Eigen::MatrixXd& row, bool second) {
        return half_s({int(row.cols()) - 1, 0, row}, second).coefficient;
    };
    std::vector<Part> open{{std::move(left), std::move(right), 0, 1, 0}};
    while (!open.empty()) {
        const Part part = std::move(open.back());
        open.pop_back();
        const double largest = part.left.colwise().norm().maxCoeff() * part.right.colwise().norm().maxCoeff();
        if ((part.left.transpose() * part.right).minCoeff() > rounding * largest)
            continue;
        const double middle = (part.from + part.to) / 2;
        if (part.depth == most_halvings)
            return middle;
        open.push_back({half(part.left, true), half(part.right, true), middle, part.to, part.depth + 1});
        open.push_back({half(part.left, false), half(part.right, false), part.from, middle, part.depth + 1});
    }
    return std::nullopt;
}

/// The coefficients along a border of a span: its end (or beginning) along u, or along v.
Eigen::MatrixXd border(const BezierPatch& f, bool along_v, bool end)
{
    const int count = (along_v ? f.degree_t : f.degree_s) + 1;
    Eigen::MatrixXd result(f.coefficient.rows(), count);
    for (int k = 0; k < count; ++k)
        result.col(k) = along_v ? f.at(end ? f.degree_s : 0, k) : f.at(k, end ? f.degree_t : 0);
    return result;
}

bool kinked(const std::vector<double>& knots, int degree, int span)
{
    return std::count(knots.begin(), knots.end(), knots[size_t(span)]) >= degree;
}

void prove(const NurbsSurface& s, PatchCertificate& certificate, const Progress& progress)
{
    const bool rational = (s.weight.array() != 1).any();
    const std::vector<int> u = spans(s.knots_u, s.degree_u), v = spans(s.knots_v, s.degree_v);
    std::vector<BezierPatch> before(u.size()); // of the last row of spans
    double bound = std::numeric_limits<double>::infinity();
    for (size_t j = 0; j < v.size(); ++j) {
        const Progress row = progress.part(double(j) / double(v.size()), double(j + 1) / double(v.size()));
        row.checkpoint(0, proving);
        for (size_t i = 0; i < u.size(); ++i) {
            const BezierPatch homogeneous = bezier_of(s, u[i], v[j]);
            const double u0 = s.knots_u[size_t(u[i])], u1 = s.knots_u[size_t(u[i]) + 1], v0 = s.knots_v[size_t(v[j])],
                         v1 = s.knots_v[size_t(v[j]) + 1];
            const Piece piece{numerator(homogeneous, rational), u0, u1, v0, v1};
            const double weight = homogeneous.coefficient.row(3).maxCoeff();
            const double least = prove_span(s, piece, certificate, row);
            if (certificate.refusal)
                return;
            bound = std::min(bound, least / (std::pow(weight, 3) * (u1 - u0) * (v1 - v0)));
            if (i > 0 && kinked(s.knots_u, s.degree_u, u[i]))
                if (const auto at = kink(border(before[i - 1], true, true), border(piece.normal, true, false)))
                    certificate.refusal = {Refusal::Why::sharp_edge, place_of(s, u0, v0 + *at * (v1 - v0))};
            if (j > 0 && kinked(s.knots_v, s.degree_v, v[j]))
                if (const auto at = kink(border(before[i], false, true), border(piece.normal, false, false)))
                    certificate.refusal = {Refusal::Why::sharp_edge, place_of(s, u0 + *at * (u1 - u0), v0)};
            if (certificate.refusal)
                return;
            before[i] = piece.normal;
        }
    }
    certificate.proved_jacobian = bound;
}

void sample(const SurfacePoint& at, double u, double v, PatchCertificate& c, double& scaled, double& skew, int& count)
{
    const double jacobian = at.S_u.cross(at.S_v).norm(), a = at.S_u.norm(), b = at.S_v.norm();
    c.least_jacobian = std::min(c.least_jacobian, jacobian);
    c.greatest_jacobian = std::max(c.greatest_jacobian, jacobian);
    const double here = a > 0 && b > 0 ? jacobian / (a * b) : 0;
    if (here < c.least_scaled || count == 0) {
        c.least_scaled = here;
        c.least_scaled_at = {u, v, at.position};
    }
    scaled += here;
    skew += a > 0 && b > 0 ? std::pow(at.S_u.dot(at.S_v) / (a * b), 2) : 1;
    c.condition = std::max(c.condition,
                           jacobian > 0 ? (a * a + b * b) / (2 * jacobian) : std::numeric_limits<double>::infinity());
    ++count;
}

double ratio(double a, double b) { return std::max(a, b) / std::min(a, b); }

void measure(const NurbsSurface& s, PatchCertificate& c, const Progress& progress)
{
    const std::vector<double> u = span_borders(s.knots_u, s.degree_u), v = span_borders(s.knots_v, s.degree_v);
    c.least_jacobian = std::numeric_limits<double>::infinity();
    double scaled = 0, skew = 0;
    int count = 0;
    for (const double y : v)
        for (const double x : u)
            sample(evaluate(s, x, y), x, y, c, scaled, skew, count);
    std::vector<double> row(u.size() - 1, 0);
    std::vector<SurfacePoint> point(16 * row.size()); // of one row of spans
    const auto at_gauss = [](const std::vector<double>& borders, size_t span, int k) {
        return (borders[span] + borders[span + 1] + gauss_place[k] * (borders[span + 1] - borders[span])) / 2;
    };
    for (size_t j = 0; j + 1 < v.size(); ++j) {
        progress.checkpoint(double(j) / double(v.size() - 1), examining);
        parallel_for(int(point.size()), [&](int k) {
            point[size_t(k)] = evaluate(s, at_gauss(u, size_t(k) / 16, k % 4), at_gauss(v, j, k / 4 % 4));
        });
        double left = 0;
        for (size_t i = 0; i + 1 < u.size(); ++i) {
            double area = 0, along_u = 0, along_v = 0;
            for (int b = 0; b < 4; ++b)
                for (int a = 0; a < 4; ++a) {
                    const SurfacePoint& at = point[16 * i + size_t(4 * b + a)];
                    sample(at, at_gauss(u, i, a), at_gauss(v, j, b), c, scaled, skew, count);
                    const double share = gauss_share[a] * gauss_share[b] / 4;
                    area += share * at.S_u.cross(at.S_v).norm();
                    along_u += share * at.S_u.norm();
                    along_v += share * at.S_v.norm();
                }
            area *= (u[i + 1] - u[i]) * (v[j + 1] - v[j]);
            c.aspect = std::max(c.aspect, ratio(along_u * (u[i + 1] - u[i]), along_v * (v[j + 1] - v[j])));
            if (i > 0)
                c.neighbour_area = std::max(c.neighbour_area, ratio(area, left));
            if (j > 0)
                c.neighbour_area = std::max(c.neighbour_area, ratio(area, row[i]));
            left = row[i] = area;
        }
    }
    c.mean_scaled = scaled / count;
    c.orthogonality = skew / count;
}

Eigen::Vector3d normal_on(const NurbsSurface& surface, Side side, double t)
{
    switch (side) {
    case Side::v0: return evaluate(surface, t, 0).normal();
    case Side::u1: return evaluate(surface, 1, t).normal();
    case Side::v1: return evaluate(surface, t, 1).normal();
    case Side::u0: break;
    }
    return evaluate(surface, 0, t).normal();
}

/// Whether the patch lies on the left of the side's curve as seen along its normal.
bool on_the_left(Side side) { return side == Side::v0 || side == Side::u1; }

InterfaceCertificate measure(const MultiPatch& patches, const PatchInterface& joint)
{
    const NurbsSurface &a = patches.patch[size_t(joint.first.patch)], &b = patches.patch[size_t(joint.second.patch)];
    const std::vector<double> t = span_borders(side_knots(a, joint.first.side), side_degree(a, joint.first.side));
    // The normals point to one side of the sheet if the patches lie on different sides of the
    // common curve.
    const bool agree = on_the_left(joint.first.side) != (on_the_left(joint.second.side) != joint.reversed);
    InterfaceCertificate result{joint, 0, 0};
    int count = 0;
    for (size_t k = 0; k + 1 < t.size(); ++k)
        for (int n = 0; n < (k + 2 == t.size() ? 5 : 4); ++n) {
            const double here = t[k] + n / 4. * (t[k + 1] - t[k]);
            const Eigen::Vector3d x = normal_on(a, joint.first.side, here),
                                  y = (agree ? 1 : -1) *
                                      normal_on(b, joint.second.side, joint.reversed ? 1 - here : here);
            const double angle = std::atan2(x.cross(y).norm(), x.dot(y));
            result.greatest_angle = std::max(result.greatest_angle, angle);
            result.mean_angle += angle;
            ++count;
        }
    result.mean_angle /= count;
    return result;
}

} // namespace

bool Certificate::suited() const
{
    return leak.empty() &&
           std::none_of(patch.begin(), patch.end(), [](const PatchCertificate& c) { return c.refusal.has_value(); });
}

const PatchCertificate& Certificate::poorest() const
{
    return *std::ranges::min_element(patch, {}, &PatchCertificate::least_scaled);
}

Certificate certify(const MultiPatch& patches, const Progress& progress)
{
    Certificate result;
    for (size_t p = 0; p < patches.patch.size(); ++p) {
        require_patch(patches.patch[p], p);
        PatchCertificate& one = result.patch.emplace_back();
        const double all = double(patches.patch.size());
        const Progress here = progress.part(double(p) / all, double(p + 1) / all);
        prove(patches.patch[p], one, here.part(0, 0.6));
        measure(patches.patch[p], one, here.part(0.6, 1));
    }
    try {
        require_watertight(patches);
    } catch (const InputError& leak) {
        result.leak = leak.what();
        return result;
    }
    for (const PatchInterface& joint : patches.interfaces) {
        progress.checkpoint(1, "examining the joins of the patches");
        result.interfaces.push_back(measure(patches, joint));
    }
    return result;
}

std::string describe(const Refusal& refusal)
{
    const char* what = refusal.why == Refusal::Why::folded     ? "folds"
                       : refusal.why == Refusal::Why::vanishes ? "has no normal"
                                                               : "turns by 90 degrees or more over a kink";
    const Eigen::Vector3d& at = refusal.place.position;
    return fmt::format("{} at u = {:.4g}, v = {:.4g} ({} mm)", what, refusal.place.u, refusal.place.v, place_text(at));
}

} // namespace spia
