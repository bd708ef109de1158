#include "engine/forming/sheet_fields.h"

#include <Eigen/Dense>

#include "engine/core/parallel.h"

namespace spia {

SheetFields face_fields(const TriMesh& part, const std::vector<Element>& element, const Blank& blank,
                        const Sheet& sheet)
{
    const int faces = part.triangles();
    SheetFields out;
    for (Eigen::VectorXd* field :
         {&out.thickness, &out.thinning, &out.strain_major, &out.strain_minor, &out.strain_equivalent,
          &out.stress_major, &out.stress_minor, &out.stress_equivalent})
        field->resize(faces);
    out.direction_major.resize(3, faces);
    out.necking.resize(faces);
    parallel_for(faces, [&](int f) {
        const Element& e = element[size_t(f)];
        const Svd2 d = svd(inverse_gradient(e, corners(blank.position, part.triangle.col(f))));
        const MembraneLaw& law = sheet.law_of(f);
        const AxisStress p = law(d.U, -d.s.array().log().matrix()); // the second singular value is the major strain's
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
    node.thickness = mean(face.thickness);
    node.thinning = mean(face.thinning);
    node.strain_major = mean(face.strain_major);
    node.strain_minor = mean(face.strain_minor);
    node.strain_equivalent = mean(face.strain_equivalent);
    node.stress_major = mean(face.stress_major);
    node.stress_minor = mean(face.stress_minor);
    node.stress_equivalent = mean(face.stress_equivalent);
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
        node.direction_major.col(v) =
            Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor[size_t(v)]).eigenvectors().col(2);
    return node;
}

} // namespace spia
