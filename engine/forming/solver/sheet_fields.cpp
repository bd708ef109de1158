#include "engine/forming/solver/sheet_fields.h"

#include "engine/core/parallel.h"
#include "engine/core/small_dense.h"

namespace spia {
SheetFields face_fields(const TriMesh& part, const std::vector<Element>& element, const Blank& blank,
                        const Sheet& sheet)
{
    const int faces = part.triangles();
    SheetFields out = sized_fields(faces);
    parallel_for(faces, [&](int f) {
        const Element& e = element[size_t(f)];
        const Svd2 d = svd(inverse_gradient(e, corners(blank.position, part.triangle.col(f))));
        const MembraneLaw& law = sheet.law_of(f);
        // the second singular value is the major strain's
        const AxisStress p = law(d.U, -d.s.array().log().matrix());
        out.strain_major[f] = -std::log(d.s[1]);
        out.strain_minor[f] = -std::log(d.s[0]);
        out.thickness[f] = sheet.thickness[f] * d.s[0] * d.s[1];
        out.thinning[f] = 1 - d.s[0] * d.s[1];
        out.strain_equivalent[f] = p.equivalent_strain;
        out.stress_major[f] = p.stress[1];
        out.stress_minor[f] = p.stress[0];
        out.stress_equivalent[f] = p.equivalent_stress;
        out.direction_major.col(f) = e.frame * d.V.col(1);
        out.necking[f] = p.equivalent_strain > law.curve().trusted_strain();
    });
    return out;
}

SheetFields node_fields(const TriMesh& part, const std::vector<Element>& element, const SheetFields& face)
{
    const int n = part.vertices();
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(n);
    for (int f = 0; f < part.triangles(); ++f)
        for (int a = 0; a < 3; ++a)
            weight[part.triangle(a, f)] += element[size_t(f)].area;
    const auto mean = [&](const Eigen::VectorXd& of_face) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
        for (int f = 0; f < part.triangles(); ++f)
            for (int a = 0; a < 3; ++a)
                sum[part.triangle(a, f)] += element[size_t(f)].area * of_face[f];
        return Eigen::VectorXd(sum.cwiseQuotient(weight));
    };
    SheetFields node;
    for (const auto& [name, field] : sheet_scalars)
        node.*field = mean(face.*field);
    node.necking = Eigen::VectorXi::Zero(n);
    std::vector<Eigen::Matrix3d> tensor(size_t(n), Eigen::Matrix3d::Zero());
    for (int f = 0; f < part.triangles(); ++f)
        for (int a = 0; a < 3; ++a) {
            const int v = part.triangle(a, f);
            node.necking[v] |= face.necking[f];
            tensor[size_t(v)] +=
                element[size_t(f)].area * face.direction_major.col(f) * face.direction_major.col(f).transpose();
        }
    node.direction_major.resize(3, n);
    for (int v = 0; v < n; ++v)
        node.direction_major.col(v) = eigen_pairs(tensor[size_t(v)]).vector.col(2);
    return node;
}

SheetFields sized_fields(Eigen::Index entries)
{
    SheetFields fields;
    for (const auto& [name, field] : sheet_scalars)
        (fields.*field).resize(entries);
    fields.direction_major.resize(3, entries);
    fields.necking.resize(entries);
    return fields;
}

void put_fields(const SheetFields& from, const std::vector<int>& at, SheetFields& to)
{
    for (size_t k = 0; k < at.size(); ++k) {
        const auto i = Eigen::Index(at[k]), j = Eigen::Index(k);
        for (const auto& [name, field] : sheet_scalars)
            (to.*field)[i] = (from.*field)[j];
        to.direction_major.col(i) = from.direction_major.col(j);
        to.necking[i] = from.necking[j];
    }
}

} // namespace spia
